// SPDX-License-Identifier: GPL-3.0-or-later
// shapes_command.cpp  macadam shapes measure | check | repair: reads surfaces, prints verdicts and writes tables.
#include "host/cli/tool_commands/shapes_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <memory>

#include "host/cli/terminal/help.hpp"
#include "host/cli/terminal/options.hpp"
#include "host/cli/tool_commands/shapes_fill.hpp"
#include "host/cli/tool_commands/shapes_generate.hpp"
#include "host/cli/terminal/streams.hpp"
#include "kernels/base/parallel.hpp"
#include "host/shapes/library/statistics.hpp"
#include "host/shapes/files/surface_files.hpp"
#include "macadam/error.hpp"
#include "macadam/shape.hpp"

namespace macadam {
namespace {

namespace fs = std::filesystem;

struct ShapesArguments {
  std::vector<std::string> paths;
  std::string out;
  double scale = 1;
  bool repair = false, wrap = false;
};

/// Returns the given files. A given folder stands for all surface files in it, sorted by name.
std::vector<fs::path> files_of(const std::vector<std::string>& paths) {
  std::vector<fs::path> files;
  for (const fs::path path : paths) {
    if (!fs::is_directory(path)) {
      files.push_back(path);
      continue;
    }
    const std::vector<fs::path> inside = surface_files_in(path);
    files.insert(files.end(), inside.begin(), inside.end());
  }
  return files;
}

/// The outcome for one file: a value or an error.
template <class T>
struct Outcome {
  T value{};
  std::string note;  ///< printed with the file's name; empty: nothing to say
  std::exception_ptr error;
};

/// Returns the changes made on reading, in words; empty for a surface that was not changed.
std::string reading_note(const Surface& surface) {
  return surface.reading.empty() ? "" : "on reading: " + surface.reading;
}

/// Calls `work` for each file, on all cores. An error in one file does not stop the others.
template <class T, class Work>
std::vector<Outcome<T>> for_each_file(const std::vector<fs::path>& files, Work&& work) {
  std::vector<Outcome<T>> outcomes(files.size());
  for_each_in_parallel(files.size(), [&](std::size_t i) {
    try {
      work(files[i], outcomes[i]);
    } catch (const Error&) { outcomes[i].error = std::current_exception(); }
  });
  return outcomes;
}

/// Throws the errors of all files in one message. A surface that cannot be repaired counts as wrong input.
template <class T>
void throw_errors(const std::vector<Outcome<T>>& outcomes) {
  std::string messages;
  std::size_t faulty = 0;
  for (const Outcome<T>& outcome : outcomes) {
    if (!outcome.error) continue;
    try {
      std::rethrow_exception(outcome.error);
    } catch (const Error& error) {
      messages += fmt::format("\n  {}", error.what());
      ++faulty;
    }
  }
  if (faulty == 0) return;
  throw InputError(fmt::format("{} of {} files have faults:{}", faulty, outcomes.size(), messages));
}

void measure(const ShapesArguments& arguments) {
  const std::vector<fs::path> files = files_of(arguments.paths);
  const auto outcomes = for_each_file<ShapeMeasure>(files, [&](const fs::path& file, Outcome<ShapeMeasure>& outcome) {
    Surface surface = read_surface(file, arguments.scale);
    surface.name = file.string();  // shown in messages
    outcome.note = reading_note(surface);
    if (arguments.repair && !check_surface(surface).good()) {
      SurfaceRepair repair;
      surface = repair_surface(surface, &repair, {}, arguments.wrap);
      outcome.note +=
          fmt::format("{}repaired: {}; {}", outcome.note.empty() ? "" : "; ", repair.what, repair.changes());
    }
    outcome.value = measure_shape(surface);
  });
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (!outcomes[i].note.empty()) say("{}: {}\n", files[i].string(), outcomes[i].note);
  }
  throw_errors(outcomes);
  std::vector<std::string> names;
  std::vector<ShapeMeasure> shapes;
  for (std::size_t i = 0; i < files.size(); ++i) {
    names.push_back(files[i].stem().string());
    shapes.push_back(outcomes[i].value);
  }
  write_shape_tables(arguments.out, names, shapes);
  say("{}", statistics_text(shapes));
  if (std::any_of(shapes.begin(), shapes.end(), [](const ShapeMeasure& m) { return m.d_long > 1; })) {
    say("warning: some aggregates are larger than 1 m; if the files are in millimetres, give --scale 1e-3\n");
  }
  say("\nfiles in {}: shapes.csv statistics.csv correlation.csv\n", arguments.out);
}

void check(const ShapesArguments& arguments) {
  const std::vector<fs::path> files = files_of(arguments.paths);
  const auto outcomes = for_each_file<bool>(files, [&](const fs::path& file, Outcome<bool>& outcome) {
    const Surface surface = read_surface(file);
    const SurfaceVerdict verdict = check_surface(surface);
    outcome.note = verdict.text() + (surface.reading.empty() ? "" : "; " + reading_note(surface));
    outcome.value = verdict.good();
  });
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (!outcomes[i].error) say("{}: {}\n", files[i].string(), outcomes[i].note);
  }
  flush_output();
  throw_errors(outcomes);
  const auto good = std::count_if(outcomes.begin(), outcomes.end(), [](const auto& o) { return o.value; });
  if (const auto all = std::ssize(files); good < all) {
    throw InputError(fmt::format("{} of {} surfaces cannot be measured and filled", all - good, all));
  }
}

void repair(const ShapesArguments& arguments) {
  const fs::path file = arguments.paths.front();
  Surface surface = read_surface(file);
  surface.name = file.string();  // shown in messages
  if (!surface.reading.empty()) say("{}: {}\n", file.string(), reading_note(surface));
  SurfaceRepair repair;
  surface = repair_surface(surface, &repair, arguments.out, arguments.wrap);
  write_surface(arguments.out, surface);
  say("{}: {}; {}\n", file.string(), repair.what, repair.changes());
  say("{}: {} points, {} facets\n", arguments.out, surface.points.size(), surface.facets.size());
}

}  // namespace

void add_shapes_command(CLI::App& app) {
  CLI::App& shapes =
      *app.add_subcommand("shapes", "measure, repair, fill or make shapes of aggregates (closed surfaces)");
  shapes.require_subcommand(1);
  const auto arguments = std::make_shared<ShapesArguments>();
  const auto add_paths = [&](CLI::App& command) {
    command.add_option("paths", arguments->paths, "STL, OFF, PLY or OBJ files, or folders of them")
        ->required()
        ->type_name("FILE");
  };

  CLI::App& measure_app =
      *shapes.add_subcommand("measure", "print dimensions, volume, area and shape indices of each shape");
  add_paths(measure_app);
  add_out(measure_app, arguments->out, "of the tables");
  add_scale(measure_app, arguments->scale);
  measure_app.add_flag("--repair", arguments->repair, "repair faulty surfaces before measuring them");
  const auto add_wrap = [&](CLI::App& command) {
    return command.add_flag(
        "--wrap", arguments->wrap,
        "accept a repair that wraps a new surface around a faulty one, even if volume or area change by more than 1 %");
  };
  add_wrap(measure_app)->needs("--repair");
  measure_app.callback([arguments] { measure(*arguments); });

  CLI::App& check_app = *shapes.add_subcommand("check", "list the faults of each surface and where they are");
  add_paths(check_app);
  check_app.callback([arguments] { check(*arguments); });

  CLI::App& repair_app = *shapes.add_subcommand("repair", "repair a surface so that it can be measured and filled");
  repair_app.add_option("file", arguments->paths, "STL, OFF, PLY or OBJ file")
      ->required()
      ->expected(1)
      ->type_name("FILE");
  add_text(repair_app, "--out", arguments->out,
           "file to write; its ending (.stl, .off, .ply or .obj) chooses the format")
      ->required();
  add_wrap(repair_app);
  repair_app.callback([arguments] { repair(*arguments); });

  add_examples(shapes, {"macadam shapes measure examples/shapes --out results/measured", "macadam shapes fill --help"});
  add_examples(measure_app, {"macadam shapes measure examples/shapes --out results/measured"});
  add_examples(check_app,
               {"macadam shapes check examples/shapes", "macadam shapes check examples/icosahedron/icosahedron.off"});
  add_examples(repair_app, {"macadam shapes repair examples/shapes/aggregate_01.off --out aggregate_01.stl"});

  // Each of these commands is in a file of its own, which adds it here.
  add_shapes_fill(shapes);
  add_shapes_generate(shapes);
}

}  // namespace macadam
