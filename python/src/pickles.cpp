// SPDX-License-Identifier: GPL-3.0-or-later
// pickles.cpp  Converts scenes and specimens to tuples of plain values and back, for pickle.
#include "python/src/pickles.hpp"

#include <nanobind/stl/array.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <optional>
#include <tuple>

#include "python/src/arrays.hpp"
#include "python/src/calls.hpp"
#include "python/src/given_arrays.hpp"

namespace macadam::python {
namespace {

/// The members of a CompositionRow: name, count_asked, count, fraction_asked, fraction.
using Row = std::tuple<std::string, std::int64_t, std::int64_t, double, double>;

/// The members of an Aggregate by type: its shape's name; the integers body, size_class, spheres, surface; 18 numbers
/// in the order that state_of() lists.
using AggregateState = std::tuple<std::string, std::array<std::int64_t, 4>, std::array<double, 18>>;

AggregateState state_of(const Aggregate& a) {
  const Vec3d &axis = a.axis_long, &c = a.centre, &p = a.pose.centre;
  const auto& turn = a.pose.turn;
  return {a.shape,
          {a.body, a.size_class, a.spheres, a.surface},
          {a.size, a.d_long, a.d_short, a.volume, axis.x, axis.y, axis.z, c.x, c.y, c.z, p.x, p.y, p.z, turn[0],
           turn[1], turn[2], turn[3], a.pose.scale}};
}

Aggregate aggregate_of(const AggregateState& state) {
  const auto& [shape, counts, x] = state;
  Aggregate a;
  a.shape = shape;
  a.body = static_cast<std::int32_t>(counts[0]), a.size_class = static_cast<std::int32_t>(counts[1]);
  a.spheres = counts[2], a.surface = static_cast<std::int32_t>(counts[3]);
  a.size = x[0], a.d_long = x[1], a.d_short = x[2], a.volume = x[3];
  a.axis_long = {x[4], x[5], x[6]}, a.centre = {x[7], x[8], x[9]};
  a.pose = {{x[10], x[11], x[12]}, {x[13], x[14], x[15], x[16]}, x[17]};
  return a;
}

/// Returns the length and compliance of each contact and the report of the rock, which the rule "series" sets. The true
/// surfaces of aggregates, from which this follows, are not part of a specimen. Empty lists with the rule "centres".
nb::tuple series_of(const Preparation& made) {
  std::vector<double> lengths, compliances, rock;
  if (made.rock) {
    for (const Contact& c : made.network.contacts) lengths.push_back(c.length), compliances.push_back(c.series);
    rock = {made.rock->rock_cells, made.rock->rock_nominal.value_or(-1), made.rock->void_cells, made.rock->void_nominal,
            static_cast<double>(made.rock->mastic_centres_in_rock)};
  }
  return nb::make_tuple(lengths, compliances, rock);
}

/// Restores in `made` what series_of() returned.
void put_series(const nb::tuple& state, Preparation& made) {
  const auto lengths = nb::cast<std::vector<double>>(state[0]), compliances = nb::cast<std::vector<double>>(state[1]),
             rock = nb::cast<std::vector<double>>(state[2]);
  if (rock.empty()) return;
  for (std::size_t k = 0; k < made.network.contacts.size(); ++k)
    made.network.contacts[k].length = lengths.at(k), made.network.contacts[k].series = compliances.at(k);
  made.rock = RockReport{rock[0], rock[1] < 0 ? std::nullopt : std::optional(rock[1]), rock[2], rock[3],
                         static_cast<std::int64_t>(rock[4])};
}

/// Returns the data of a generated specimen other than its spheres: composition, aggregates, iterations, times, and
/// the lengths that the rule "series" sets.
nb::tuple report_of(const Preparation& made) {
  std::vector<Row> composition;
  for (const CompositionRow& r : made.composition)
    composition.emplace_back(r.name, r.count_asked, r.count, r.fraction_asked, r.fraction);
  std::vector<AggregateState> aggregates;
  for (const Aggregate& a : made.aggregates) aggregates.push_back(state_of(a));
  const std::array<double, 3> seconds{made.seconds_specimen, made.seconds_tessellation, made.seconds_network};
  return nb::make_tuple(composition, aggregates, made.relaxation_iterations, seconds, series_of(made));
}

/// Restores in `made` what report_of() returned.
void put_report(const nb::tuple& report, Preparation& made) {
  for (const auto& [name, count_asked, count, fraction_asked, fraction] : nb::cast<std::vector<Row>>(report[0]))
    made.composition.push_back({name, count_asked, count, fraction_asked, fraction});
  for (const AggregateState& a : nb::cast<std::vector<AggregateState>>(report[1]))
    made.aggregates.push_back(aggregate_of(a));
  made.relaxation_iterations = nb::cast<int>(report[2]);
  const auto seconds = nb::cast<std::array<double, 3>>(report[3]);
  made.seconds_specimen = seconds[0], made.seconds_tessellation = seconds[1], made.seconds_network = seconds[2];
  if (report.size() > 4) put_series(nb::cast<nb::tuple>(report[4]), made);
}

/// Returns bounding box, particles, voids, source, and name and dimensions of the domain of a specimen, the arrays as
/// NumPy arrays.
nb::tuple spheres_of(const Specimen& s) {
  std::vector<std::int32_t> phase;
  for (const Phase p : s.phase) phase.push_back(static_cast<std::int32_t>(p));
  std::vector<Vec3d> void_centre;
  std::vector<double> void_radius;
  for (const VoidSphere& v : s.voids) void_centre.push_back(v.centre), void_radius.push_back(v.radius);
  const auto numpy = [](const std::vector<Vec3d>& v) {
    std::vector<double> flat;
    for (const Vec3d& x : v) flat.insert(flat.end(), {x.x, x.y, x.z});
    return owned(std::move(flat), {v.size(), 3});
  };
  const Vec3d box = s.box.size;
  return nb::make_tuple(std::array<double, 3>{box.x, box.y, box.z}, numpy(s.centre), owned(std::vector(s.radius)),
                        owned(std::move(phase)), owned(std::vector(s.body)), numpy(void_centre), owned(void_radius),
                        s.source, s.first_line, s.box.name(), s.box.values());
}

/// Returns the specimen that spheres_of() described.
Specimen specimen_of(const nb::tuple& spheres) {
  const auto at = [&](int k) { return ArrayLike(spheres[static_cast<std::size_t>(k)], nb::detail::borrow_t{}); };
  const auto box = nb::cast<std::array<double, 3>>(spheres[0]);
  Specimen out;
  out.box.size = {box[0], box[1], box[2]};
  if (spheres.size() > 10) {
    out.box = domain_of(nb::cast<std::string>(spheres[9]), nb::cast<std::vector<double>>(spheres[10]));
  } else if (spheres.size() > 9) {  // a pickle without dimensions
    out.box.shape = domains::shape_named(nb::cast<std::string>(spheres[9])).value();
  }
  out.centre = vectors(at(1), "centre");
  out.radius = numbers(at(2), "radius");
  for (const std::int32_t p : whole_numbers(at(3), "phase")) out.phase.push_back(static_cast<Phase>(p));
  out.body = whole_numbers(at(4), "body");
  const std::vector<Vec3d> centre = vectors(at(5), "void_centre");
  const std::vector<double> radius = numbers(at(6), "void_radius", centre.size());
  for (std::size_t i = 0; i < centre.size(); ++i) out.voids.push_back({centre[i], radius[i]});
  out.source = nb::cast<std::string>(spheres[7]);
  out.first_line = nb::cast<int>(spheres[8]);
  return out;
}

}  // namespace

void pickle_scenes(nb::class_<GivenScene>& c) {
  c.def("__getstate__", [](const nb::object& self) {
    return nb::make_tuple(self.attr("file"), self.attr("text"), self.attr("options"));
  });
  c.def("__setstate__", [](GivenScene& self, const nb::tuple& state) {
    const auto text = nb::cast<std::string>(state[1]);
    const nb::object read = nb::cast(GivenScene{read_scene(nb::cast<std::filesystem::path>(state[0]), text)});
    read.attr("override")(**nb::cast<nb::dict>(state[2]));
    new (&self) GivenScene(nb::cast<GivenScene&>(read));
    self.text = text;  // override() has added the seed to the text a second time
  });
}

void pickle_specimens(nb::class_<Prepared>& c) {
  c.def("__getstate__",
        [](const Prepared& p) { return nb::make_tuple(*p.scene, spheres_of(p.made.specimen), report_of(p.made)); });
  c.def("__setstate__", [](Prepared& self, const nb::tuple& state) {
    Specimen specimen = specimen_of(nb::cast<nb::tuple>(state[1]));
    const auto scene = std::make_shared<const GivenScene>(nb::cast<const GivenScene&>(state[0]));
    LongCall call;
    Preparation made = call([&] { return prepare(*scene, std::move(specimen), call.progress_function()); });
    put_report(nb::cast<nb::tuple>(state[2]), made);
    new (&self) Prepared{scene, std::move(made)};
  });
}

}  // namespace macadam::python
