// SPDX-License-Identifier: GPL-3.0-or-later
// edited_inputs_test.cpp  Makes one change at a time in valid input files, and compares the readers' reports with the
// recorded reports in tests/recorded/edits, one text per file. After an intended change, record again with
// MACADAM_RECORD=1 in the environment and review the difference. These tests notice changes; other tests check that
// reports are right.
#include <functional>
#include <set>

#include "host/scene/known_keys.hpp"
#include "host/simulation/forecast.hpp"
#include "macadam/laws/values.hpp"
#include "tests/support/program.hpp"
#include "tests/program/text_edits.hpp"

namespace macadam::test {
namespace {

const fs::path recorded = MACADAM_RECORDED;

/// Reads a file and returns a short description of its content; throws if it is refused.
using Reading = std::function<std::string(const fs::path&)>;

/// Returns a number with six digits, which are the same for every compiler.
std::string few_digits(double value) { return fmt::format("{:.6g}", value); }

/// Returns one number that depends on all coefficients of all laws.
double digest_of(const LawTable& laws) {
  double out = 0;
  int place = 0;
  for (const auto& law : laws) {
    if (!law) continue;
    std::visit(
        [&](auto own) {
          laws::each_value(own, [&](const std::string&, double& value, laws::ValueKind, laws::ValueNeed) {
            out += ++place * (std::isfinite(value) ? std::log(value) : -1);
          });
          out += ++place * own.alpha;
        },
        *law);
  }
  return out;
}

/// Returns a description of the run that a scene asks for, without anything that depends on the machine.
std::string run_of(const fs::path& file) {
  Scene scene = read_scene(file);
  scene.solver.backend = Backend::cpu;
  const Forecast f = forecast(scene);
  std::string out = fmt::format("{}, {}; {} particles, {} aggregates, {} voids, {} contacts; {} solutions",
                                kind_of(scene.experiment), f.stepped ? "stepped" : "harmonic", f.census.particles(),
                                f.census.aggregates, f.census.voids, few_digits(f.contacts), f.solutions);
  if (f.stepped) out += fmt::format("; {}, {}, {}", to_string(f.precision), to_string(f.form), to_string(f.geometry));
  for (const StepForecast& s : f.steps)
    out += fmt::format("; {} Hz: {} steps of {} s, scaling {}", s.frequency_hz, few_digits(s.steps), few_digits(s.dt_s),
                       few_digits(s.density_scaling));
  return out + fmt::format("; laws {}; skips {}; files {}", few_digits(digest_of(scene.laws)), fmt::join(f.skips, ", "),
                           fmt::join(f.files, " "));
}

/// Returns the number of rows and, for each column, the sum of its numbers, each multiplied by the position of its row.
std::string sums_of(std::size_t rows, const std::vector<std::vector<double>>& columns) {
  std::string out = fmt::format("{}:", rows);
  for (const std::vector<double>& column : columns) {
    double moment = 0;
    for (std::size_t i = 0; i < column.size(); ++i) moment += static_cast<double>(i + 1) * column[i];
    out += ' ' + few_digits(moment);
  }
  return out;
}

/// Returns one member of each row.
template <class Rows, class F>
std::vector<double> column_of(const Rows& rows, F&& member) {
  std::vector<double> out;
  for (const auto& row : rows) out.push_back(static_cast<double>(member(row)));
  return out;
}

std::string moduli_of(const fs::path& file) {
  const bool shear = contains(read(file), "g_star_pa");
  const ModulusData data = read_modulus_data(file, shear ? std::optional(0.4) : std::nullopt);
  std::vector<std::vector<double>> columns;
  for (double ModulusPoint::*member :
       {&ModulusPoint::frequency_hz, &ModulusPoint::e_star_pa, &ModulusPoint::phase_deg, &ModulusPoint::temperature_c,
        &ModulusPoint::e_star_std, &ModulusPoint::phase_std})
    columns.push_back(column_of(data.points, [&](const ModulusPoint& p) { return p.*member; }));
  return sums_of(data.points.size(), columns) + (data.temperatures ? ", temperatures" : "") +
         (data.deviations ? ", deviations" : "");
}

std::string model_of(const fs::path& file) {
  const ShiftedAnalogue read = read_analogue(file);
  const AnalogueModel& m = read.model;
  std::string out;
  for (const double value : {m.E_00, m.E_0, m.k, m.h, m.delta, m.tau, m.beta, laws::log10_shift(read.shift, 31)})
    out += few_digits(value) + ' ';
  return out;
}

std::string specimen_of(const fs::path& file) {
  const Specimen s = read_specimen_csv(file, {{0.008, 0.008, 0.011}});
  return sums_of(s.size(), {column_of(s.centre, [](const Vec3d& c) { return c.x; }),
                            column_of(s.centre, [](const Vec3d& c) { return c.y; }),
                            column_of(s.centre, [](const Vec3d& c) { return c.z; }), s.radius,
                            column_of(s.phase, [](Phase p) { return static_cast<int>(p); }),
                            column_of(s.body, [](std::int32_t b) { return b; })});
}

std::string surface_of(const fs::path& file) {
  const Surface s = read_surface(file);
  std::vector<std::vector<double>> columns{column_of(s.points, [](const Vec3d& p) { return p.x; }),
                                           column_of(s.points, [](const Vec3d& p) { return p.y; }),
                                           column_of(s.points, [](const Vec3d& p) { return p.z; })};
  for (std::size_t k = 0; k < 3; ++k)
    columns.push_back(column_of(s.facets, [k](const std::array<std::int32_t, 3>& f) { return f[k]; }));
  return sums_of(s.points.size(), columns) + ", " + check_surface(s).text();
}

/// An input file, its reader, and the changes that are made to it.
struct Input {
  std::string file;  ///< below tests/recorded, or "t8.csv"
  Reading read;
  std::vector<std::string> sections;  ///< sections of a scene of which every known key is tried
};

const std::vector<Input>& inputs() {
  static const std::vector<std::string> test{"[loading]", "[solver]", "[output]"};
  static const std::vector<Input> all{
      {"specimen-recipe/mix.toml", run_of, {"[specimen]", "[specimen.recipe]", "[materials]", "[materials.mastic]"}},
      {"specimen-recipe/measured.toml", run_of, {"[specimen.recipe]", "[network]"}},
      {"specimen-shapes/packed.toml", run_of, {"[specimen.shapes]", "[specimen.voids]"}},
      {"specimen-shapes/inserted.toml", run_of, {"[specimen.shapes]", "[specimen.mastic]", "[[specimen.aggregate]]"}},
      {"specimen-spheres/counted.toml", run_of, {"[specimen]", "[specimen.mastic]", "[[specimen.aggregate]]"}},
      {"run-cyclic/stepped.toml", run_of, {"[loading]", "[solver]", "[output]", "[network]", "[[contacts]]"}},
      {"run-cyclic/tolerance.toml", run_of, {"[loading]", "[solver]"}},
      {"run-cyclic/inertia.toml", run_of, {"[loading]", "[solver]", "[output]"}},
      {"run-tests/sweep.toml", run_of, test},
      {"run-tests/creep.toml", run_of, test},
      {"run-tests/stepped-creep.toml", run_of, test},
      {"run-tests/relaxation.toml", run_of, test},
      {"run-tests/stepped-monotonic.toml", run_of, test},
      {"run-tests/bonds.toml", run_of, {"[loading]", "[[contacts]]"}},
      {"fit/one.csv", moduli_of, {}},
      {"fit/two.csv", moduli_of, {}},
      {"calibrate/parts.csv", moduli_of, {}},
      {"fit/model.toml", model_of, {}},
      {"fit/huet.toml", model_of, {}},
      {"t8.csv", specimen_of, {}},
      {"shapes/cube.stl", surface_of, {}},
      {"shapes/box.ply", surface_of, {}},
      {"shapes/box.obj", surface_of, {}},
      {"shapes/stones/aggregate_04.off", surface_of, {}},
  };
  return all;
}

/// Replaces the library of crushed aggregates by icosahedra, because generating it takes a hundred times as long as
/// everything else in a forecast.
void quick_shapes(std::string& scene) {
  for (const std::string slow : {"\"aggregates\"", "\"aggregates and icosahedron\""})
    if (const std::size_t at = scene.find(slow); at != std::string::npos)
      scene.replace(at, slow.size(), "\"icosahedron\"");
}

/// Returns the numbers of the lines to change. These are all lines of a scene. In other files they are only the first
/// dozen and the last two lines, because the lines between are similar.
std::vector<std::size_t> lines_to_change(const std::vector<std::string>& all, const std::string& ending) {
  std::vector<std::size_t> out;
  std::size_t rows = 0;
  for (std::size_t n = 0; n < all.size(); ++n) {
    if (all[n].empty() || all[n].starts_with('#') || all[n].starts_with('[')) continue;
    ++rows;
    if (ending == ".toml" || rows <= 12 || n + 2 >= all.size()) out.push_back(n);
  }
  return out;
}

/// Returns all changes of a text that are tried. The lines after the first `own_lines` are laws that many scenes share;
/// they are changed only if `sections` contains their section.
std::vector<TextEdit> edits_of(const std::string& text, std::size_t own_lines, const std::string& ending,
                               const std::vector<std::string>& sections) {
  const auto is_named = [&](const std::string& section) {
    return std::find(sections.begin(), sections.end(), section) != sections.end();
  };
  std::vector<TextEdit> out;
  std::vector<std::string> lines = lines_of(text);
  if (!is_named("[[contacts]]")) lines.resize(own_lines);
  const std::vector<std::size_t> which = lines_to_change(lines, ending);
  if (ending == ".toml") {
    edits::replace_parts(out, text, which, {"0", "-1", "1", "1e-6", "1e9", "nan"}, edits::numbers);
    std::set<std::string> tried;  // a key is listed once for each experiment or law that has it
    for (const scene::KnownKey& key : scene::known_keys()) {
      if (!is_named(key.section) || !tried.insert(key.section + key.name).second) continue;
      std::vector<std::string> values{"0", "-1", "1", "2.5", "1e9", "true", "\"5 %\"", "[]", "[0.5, 2.0]"};
      for (const std::string& choice : key.words.choices) values.push_back('"' + choice + '"');
      edits::set_key(out, text, key.section, key.name, values);
    }
  } else {
    const std::string separators = ending == ".csv" ? "," : " /";
    edits::replace_parts(out, text, which, {"", "0", "-1", "1", "3", "100", "nan", "1e400", "x"},
                         [&](const std::string& line) { return edits::cells(line, separators); });
  }
  edits::replace_lines(out, text, which);
  return out;
}

class EditedInputs : public Program, public testing::WithParamInterface<Input> {
 protected:
  std::string said(const Input& input, const fs::path& file, const std::string& text) const {
    write(file, text);
    std::string out;
    try {
      out = input.read(file);
    } catch (const Error& error) { out = error.what(); }
    for (const std::string folder = folder_.string() + '/';;) {
      const std::size_t at = out.find(folder);
      if (at == std::string::npos) return out;
      out.erase(at, folder.size());
    }
  }

  /// Returns one line per changed place, followed by one line per distinct report with the changes that lead to
  /// it.
  std::string happened(const Input& input) const {
    const bool is_specimen = input.file == "t8.csv";
    const fs::path file = folder_ / fs::path(input.file).filename();
    std::string text = read(is_specimen ? file : recorded / input.file);
    const std::size_t own_lines = lines_of(text).size();
    if (contains(text, "[specimen]") && !contains(text, "[[contacts]]")) text += '\n' + read(recorded / "laws.toml");
    quick_shapes(text);
    const std::string good = said(input, file, text);
    EXPECT_EQ(good.find("expected"), std::string::npos) << "no good file: " << good;
    std::string out = "as it is: " + good + '\n';
    const std::vector<TextEdit> all = edits_of(text, own_lines, file.extension(), input.sections);
    for (std::size_t i = 0; i < all.size();) {
      const std::string& place = all[i].place;
      out += place + '\n';
      std::vector<std::pair<std::string, std::string>> groups;  // report, and the changes that lead to it
      for (; i < all.size() && all[i].place == place; ++i) {
        std::string now = said(input, file, all[i].text);
        if (now == good) now = "the same";
        const auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.first == now; });
        if (group == groups.end())
          groups.emplace_back(now, all[i].change);
        else
          group->second += " | " + all[i].change;
      }
      for (const auto& [what, changes] : groups) out += "  " + changes + ": " + what + '\n';
    }
    return out;
  }
};

TEST_P(EditedInputs, AreReadOrRefusedAsTheyWere) {
  const Input& input = GetParam();
  std::string name = input.file;
  std::replace(name.begin(), name.end(), '/', '-');
  const fs::path file = recorded / "edits" / (name + ".txt");
  const std::string now = happened(input);
  if (std::getenv("MACADAM_RECORD")) {
    fs::create_directories(file.parent_path());
    write(file, now);
    return;
  }
  const std::vector<std::string> expected = lines_of(read(file)), found = lines_of(now);
  EXPECT_EQ(found.size(), expected.size());
  int shown = 0;
  for (std::size_t n = 0; n < std::min(found.size(), expected.size()) && shown < 10; ++n)
    if (found[n] != expected[n]) {
      ADD_FAILURE() << file << ":" << n + 1 << ": found\n" << found[n] << "\nexpected\n" << expected[n];
      ++shown;
    }
}

std::string name_of(const testing::TestParamInfo<Input>& info) {
  std::string out = info.param.file;
  std::replace_if(
      out.begin(), out.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return out;
}

INSTANTIATE_TEST_SUITE_P(Files, EditedInputs, testing::ValuesIn(inputs()), name_of);

}  // namespace
}  // namespace macadam::test
