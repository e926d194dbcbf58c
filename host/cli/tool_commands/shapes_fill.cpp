// SPDX-License-Identifier: GPL-3.0-or-later
// shapes_fill.cpp  Implements `macadam shapes fill FILE --radius MIN[,MAX] --out DIR`.
#include "host/cli/tool_commands/shapes_fill.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "host/cli/terminal/fractions.hpp"
#include "host/cli/terminal/help.hpp"
#include "host/cli/terminal/options.hpp"
#include "host/cli/terminal/streams.hpp"
#include "macadam/lengths.hpp"
#include "macadam/macadam.hpp"
#include "macadam/shape.hpp"

namespace macadam {
namespace {

struct ShapesFillArguments {
  std::string file, out, circumscribed;
  std::vector<std::string> radius;
  double scale = 1;
  FillSpec spec;
};

void print_report(const Surface& surface, const MultiSphere& cluster, const FillReport& r) {
  const ShapeMeasure m = measure_shape(surface);
  const auto [low, high] = std::minmax_element(cluster.radius.begin(), cluster.radius.end());
  say("{}: {} sphere{} of {:.4g} to {:.4g} mm\n", surface.name, cluster.size(), cluster.size() == 1 ? "" : "s",
      1e3 * *low, 1e3 * *high);
  say("{:<26} {:>10} {:>10}\n", "", "shape", "spheres");
  const auto row = [](const char* what, double shape, double spheres) {
    say("{:<26} {:>10.4g} {:>10.4g}\n", what, shape, spheres);
  };
  row("volume, sum (mm3)", 1e9 * m.volume, 1e9 * r.sphere_volume);
  row("D^L (mm)", 1e3 * m.d_long, 1e3 * r.d_long);
  row("D^I (mm)", 1e3 * m.d_intermediate, 1e3 * r.d_intermediate);
  row("D^S (mm)", 1e3 * m.d_short, 1e3 * r.d_short);
  say("the spheres cover {:.2f} % of the shape's volume; their volume outside the shape is {:.2f} % of the shape's "
      "volume; the largest overlap of two spheres is {:.1f} % of the sum of their radii\n",
      100 * r.covered, 100 * r.outside, 100 * r.largest_overlap);
  say("surface deviation {:.4g} mm on average, {:.4g} mm at most\n", 1e3 * r.deviation_mean, 1e3 * r.deviation_largest);
}

void fill_command(ShapesFillArguments arguments) {
  FillSpec& spec = arguments.spec;
  spec.radius_min = length_of(arguments.radius.front(), "--radius");
  spec.radius_max = length_of(arguments.radius.back(), "--radius");
  Surface surface = read_surface(arguments.file, arguments.scale);
  if (!surface.reading.empty()) say("{}: on reading: {}\n", arguments.file, surface.reading);
  if (!arguments.circumscribed.empty()) {
    const double radius = length_of(arguments.circumscribed, "--circumscribed");
    if (!(radius > 0))
      throw InputError("command line", 0, "--circumscribed", "\"" + arguments.circumscribed + "\"",
                       "a positive length");
    surface = scale_to_radius(std::move(surface), radius);
  }
  const MultiSphere cluster = fill_shape(surface, spec);
  write_filling(arguments.out, surface, cluster);
  print_report(surface, cluster, measure_fill(surface, cluster));
  say("files in {}: spheres.csv spheres.obj shape.obj (metres)\n", arguments.out);
}

}  // namespace

void add_shapes_fill(CLI::App& shapes) {
  const auto arguments = std::make_shared<ShapesFillArguments>();
  FillSpec& spec = arguments->spec;
  CLI::App* fill = shapes.add_subcommand("fill", "fill a shape with spheres");
  fill->add_option("file", arguments->file, "closed surface (STL, OFF, PLY or OBJ)")->required()->type_name("FILE");
  fill->add_option("--radius", arguments->radius,
                   "radius of the spheres, or their smallest and largest radius: \"0.75 mm,1 mm\"")
      ->required()
      ->delimiter(',')
      ->expected(1, 2)
      ->type_name("LENGTH");
  add_fraction(*fill, "--porosity", spec.porosity,
               "1 - sum of the spheres' volumes / volume of the shape; negative if the spheres overlap", -0.5, 1.0);
  add_number(*fill, "--least", spec.least, "a shape that needs fewer spheres than this becomes a single sphere", 1,
             1'000'000);
  add_choice(*fill, "--single", spec.single,
             "radius of a single sphere: D^I/2, the circumscribed radius, or the radius of equal volume",
             {{"intermediate", SingleSphere::intermediate},
              {"circumscribed", SingleSphere::circumscribed},
              {"volume", SingleSphere::volume}});
  add_number(*fill, "--seed", spec.seed, "seed of the filling: another seed gives other spheres", 0,
             std::numeric_limits<std::uint64_t>::max());
  add_text(*fill, "--circumscribed", arguments->circumscribed,
           "scale the shape so that half of its intermediate diameter D^I has this length: \"6.295 mm\"", "LENGTH");
  add_scale(*fill, arguments->scale);
  add_out(*fill, arguments->out);
  add_examples(*fill, {"macadam shapes fill examples/shapes/aggregate_07.off --circumscribed \"6.3 mm\" --radius "
                       "\"0.75 mm,1 mm\" --out results/filled"});
  fill->callback([arguments] { fill_command(*arguments); });
}

}  // namespace macadam
