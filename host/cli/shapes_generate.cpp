// SPDX-License-Identifier: GPL-3.0-or-later
// shapes_generate.cpp  macadam shapes generate: the shape library, made anew and written as OFF files.
#include "host/cli/shapes_generate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>

#include "host/cli/help.hpp"
#include "host/cli/options.hpp"
#include "host/cli/streams.hpp"
#include "host/results/result_folder.hpp"
#include "host/shapes/surface_files.hpp"
#include "macadam/error.hpp"
#include "macadam/shape.hpp"

namespace macadam {
namespace {

struct Arguments {
  std::string out;
  std::uint64_t seed = 1;
  int count = 82;
  std::optional<double> icosahedron;  ///< radius [m]
};

/// A folder is a library: shapes of another one in it would be taken for its own.
void refuse_others(const std::filesystem::path& folder, const std::vector<Surface>& shapes) {
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string file = entry.path().filename().string();
    const auto written = [&](const Surface& shape) { return file == shape.name + ".off"; };
    if (is_surface_file(entry.path()) && std::none_of(shapes.begin(), shapes.end(), written))
      throw InputError(folder.string(), 0, "folder", file, "no shapes but those that are written now");
  }
}

void generate(const Arguments& arguments) {
  const std::vector<Surface> shapes = arguments.icosahedron
                                          ? std::vector<Surface>{subdivided_icosahedron(*arguments.icosahedron)}
                                          : generate_shape_library(arguments.seed, arguments.count);
  const ResultFolder folder(arguments.out);
  refuse_others(arguments.out, shapes);
  for (const Surface& shape : shapes) {
    write_surface(std::filesystem::path(arguments.out) / (shape.name + ".off"), shape);
  }
  say("{} shapes in {}: {}.off{}\n", shapes.size(), arguments.out, shapes.front().name,
      shapes.size() > 1 ? fmt::format(" … {}.off", shapes.back().name) : "");
}

}  // namespace

void add_shapes_generate(CLI::App& shapes) {
  CLI::App& command = *shapes.add_subcommand("generate", "make the library of crushed aggregates, in metres");
  const auto arguments = std::make_shared<Arguments>();
  add_out(command, arguments->out, "of the OFF files");
  auto* seed = add_number(command, "--seed", arguments->seed, "another library with the same statistics", 0,
                          std::numeric_limits<std::uint64_t>::max());
  auto* count = add_number(command, "--count", arguments->count, "how many shapes", 1, 10'000);
  add_number(command, "--icosahedron", arguments->icosahedron, "instead: the subdivided icosahedron of this radius [m]",
             1e-9, 1e9)
      ->excludes(seed)
      ->excludes(count);
  add_examples(command, {"macadam shapes generate --out results/library --seed 2 --count 20",
                         "macadam shapes generate --out results/ball --icosahedron 0.005"});
  command.callback([arguments] { generate(*arguments); });
}

}  // namespace macadam
