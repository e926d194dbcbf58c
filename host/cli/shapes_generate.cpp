// SPDX-License-Identifier: GPL-3.0-or-later
// shapes_generate.cpp  macadam shapes generate: the shape library, made anew and written as OFF files.
#include "host/cli/shapes_generate.hpp"

#include <fmt/format.h>

#include <memory>
#include <optional>

#include "host/results/files.hpp"
#include "macadam/shape.hpp"

namespace macadam {
namespace {

struct Arguments {
  std::string out;
  std::uint64_t seed = 1;
  int count = 82;
  std::optional<double> icosahedron;  ///< radius [m]
};

void generate(const Arguments& arguments) {
  const std::vector<Surface> shapes = arguments.icosahedron
                                          ? std::vector<Surface>{subdivided_icosahedron(*arguments.icosahedron)}
                                          : generate_shape_library(arguments.seed, arguments.count);
  make_result_folder(arguments.out);
  for (const Surface& shape : shapes) {
    write_surface(std::filesystem::path(arguments.out) / (shape.name + ".off"), shape);
  }
  fmt::print("{} shapes in {}: {}.off{}\n", shapes.size(), arguments.out, shapes.front().name,
             shapes.size() > 1 ? fmt::format(" … {}.off", shapes.back().name) : "");
}

}  // namespace

void add_shapes_generate(CLI::App& shapes) {
  CLI::App& command = *shapes.add_subcommand("generate", "make the library of crushed aggregates, in metres");
  const auto arguments = std::make_shared<Arguments>();
  command.add_option("--out", arguments->out, "folder of the OFF files; made if it is not there")->required();
  auto* seed =
      command.add_option("--seed", arguments->seed, "another library with the same statistics")->capture_default_str();
  auto* count = command.add_option("--count", arguments->count, "how many shapes")->capture_default_str();
  command.add_option("--icosahedron", arguments->icosahedron, "instead: the subdivided icosahedron of this radius (m)")
      ->excludes(seed)
      ->excludes(count);
  command.callback([arguments] { generate(*arguments); });
}

}  // namespace macadam
