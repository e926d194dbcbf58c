// SPDX-License-Identifier: GPL-3.0-or-later
// shapes_generate.cpp  macadam shapes generate: generates the shape library and writes it as OFF files.
#include "host/cli/tool_commands/shapes_generate.hpp"

#include <fmt/format.h>

#include <limits>
#include <memory>
#include <optional>

#include "host/cli/terminal/help.hpp"
#include "host/cli/terminal/options.hpp"
#include "host/cli/terminal/streams.hpp"
#include "macadam/shape.hpp"

namespace macadam {
namespace {

struct ShapesGenerateArguments {
  std::string out;
  std::uint64_t seed = 1;
  int count = 82;
  std::optional<double> icosahedron;  ///< radius [m]
};

void generate(const ShapesGenerateArguments& arguments) {
  const std::vector<Surface> shapes = arguments.icosahedron
                                          ? std::vector<Surface>{subdivided_icosahedron(*arguments.icosahedron)}
                                          : generate_shape_library(arguments.seed, arguments.count);
  write_shape_library(arguments.out, shapes);
  say("{} shapes in {}: {}.off{}\n", shapes.size(), arguments.out, shapes.front().name,
      shapes.size() > 1 ? fmt::format(" … {}.off", shapes.back().name) : "");
}

}  // namespace

void add_shapes_generate(CLI::App& shapes) {
  CLI::App& command = *shapes.add_subcommand("generate", "make the library of crushed aggregates, in metres");
  const auto arguments = std::make_shared<ShapesGenerateArguments>();
  add_out(command, arguments->out, "of the OFF files");
  auto* seed = add_number(command, "--seed", arguments->seed,
                          "seed: another seed gives another library with the same statistics", 0,
                          std::numeric_limits<std::uint64_t>::max());
  auto* count = add_number(command, "--count", arguments->count, "number of shapes", 1, 10'000);
  add_number(command, "--icosahedron", arguments->icosahedron,
             "write a subdivided icosahedron of this radius [m] instead of a library", 1e-9, 1e9)
      ->excludes(seed)
      ->excludes(count);
  add_examples(command, {"macadam shapes generate --out results/library --seed 2 --count 20",
                         "macadam shapes generate --out results/ball --icosahedron 0.005"});
  command.callback([arguments] { generate(*arguments); });
}

}  // namespace macadam
