// SPDX-License-Identifier: GPL-3.0-or-later
// mix_volumes.cpp  Converts the masses of a mix design to volumes for 1 kg of mix, according to EN 12697-5 and EN
// 12697-8 (model, section 22).
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "host/recipe/check_design.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

/// Measured densities are rounded to 1 kg/m³, so their rounding error is at most 0.5 kg/m³.
constexpr double rounding = 0.5;

/// Dry mass [kg] and volume including pores [m³] of one aggregate fraction in 1 kg of mix.
struct Portion {
  double mass = 0, volume = 0;
  Portion& operator+=(const Portion& other) {
    mass += other.mass, volume += other.volume;
    return *this;
  }
};

Portion portion(double mass, double density) { return {mass, mass / density}; }

/// Returns the mass and the volume of the aggregate between the sieves k and k + 1; `aggregate` is the mass of all
/// aggregate [kg].
Portion fraction(const MixDesign& design, std::size_t k, double aggregate) {
  const double density =
      design.aggregate_density.size() == 1 ? design.aggregate_density[0] : design.aggregate_density[k];
  return portion(aggregate * (design.gradation[k].passing - design.gradation[k + 1].passing), density);
}

/// Writes out how EN 12697-5 computes the maximum density, for messages, for example `1 kg / (0.948 kg / 2630 kg/m3 +
/// 0.052 kg / 1030 kg/m3)`. If there are several aggregates, their mean density is shown.
std::string sum_of(const Portion& all, double binder, double binder_density) {
  return fmt::format("1 kg / ({:.6g} kg / {:.6g} kg/m3 + {:.6g} kg / {:.6g} kg/m3)", all.mass, all.mass / all.volume,
                     binder, binder_density);
}

/// Returns the mass of the binder absorbed in the pores [kg], from the design or from the measured maximum density.
double absorbed_of(const MixDesign& design, const Portion& all, double binder) {
  double absorbed = all.mass * design.absorbed_binder.value_or(0);
  if (design.maximum_density) {
    // Model (22.1): 1/ρ_max = v_a + (b − absorbed)/ρ_b
    const double measured = *design.maximum_density, solid = all.volume + binder / design.binder_density;
    if (measured < 1 / solid - rounding)
      refuse(design, "maximum_density",
             fmt::format("{}, from which an absorbed binder of {} of the aggregate's mass would follow",
                         in_kg_m3(measured),
                         in_percent((binder - design.binder_density * (1 / measured - all.volume)) / all.mass)),
             fmt::format("at least {}, which is the value without absorption: {}", in_kg_m3(1 / solid),
                         sum_of(all, binder, design.binder_density)));
    absorbed = std::max(0.0, binder - design.binder_density * (1 / measured - all.volume));
    if (absorbed > binder)
      refuse(
          design, "maximum_density",
          fmt::format("{}, from which {} of the mix would be absorbed binder and {} effective binder",
                      in_kg_m3(measured), in_percent(absorbed), in_percent(binder - absorbed)),
          fmt::format("at most {}, which is the value if all the binder is absorbed: 1 kg / ({:.6g} kg / {:.6g} kg/m3)",
                      in_kg_m3(1 / all.volume), all.mass, all.mass / all.volume));
  }
  if (absorbed > binder)
    refuse(design, "absorbed_binder",
           fmt::format("{} of the aggregate's mass, which is {} of the mix and leaves an effective binder of {} - {} = "
                       "{}: the air voids would exceed the VMA",
                       in_percent(*design.absorbed_binder), in_percent(absorbed), in_percent(binder),
                       in_percent(absorbed), in_percent(binder - absorbed)),
           fmt::format("at most {} of the aggregate's mass, which is all the binder", in_percent(binder / all.mass)));
  return absorbed;
}

/// Returns the air voids as a fraction of the bulk volume: the given value or, without a given value, the value that
/// follows from the measured bulk density.
double air_voids_of(const MixDesign& design, double maximum_density) {
  if (design.air_voids) return *design.air_voids;
  const double bulk = *design.bulk_density, voids = 1 - bulk / maximum_density;  // EN 12697-8
  if (bulk > maximum_density + rounding)
    refuse(design, "bulk_density",
           fmt::format("{}, from which the air voids would be 1 - {:.6g} / {:.6g} = {}", in_kg_m3(bulk), bulk,
                       maximum_density, in_percent(voids)),
           "at most the maximum density, " + in_kg_m3(maximum_density));
  return std::max(0.0, voids);
}

}  // namespace

MixVolumes volumes_of(const MixDesign& design) {
  check(design);
  MixVolumes out;
  out.binder = design.binder_of == BinderOf::mix ? design.binder : design.binder / (1 + design.binder);
  const double aggregate = 1 - out.binder;
  const auto& curve = design.gradation;

  Portion coarse, fine;
  for (std::size_t k = 0; k + 1 < curve.size(); ++k) {
    const Portion p = fraction(design, k, aggregate);
    if (!(p.mass > 0)) continue;
    if (curve[k + 1].size < design.cut) {
      fine += p;
      continue;
    }
    coarse += p;
    // The volumes of the classes are in m³ per 1 kg of mix here. Further down they are converted to fractions of the
    // box.
    out.classes.push_back({curve[k + 1].size, curve[k].size, p.mass, p.volume, p.mass / p.volume, curve[k + 1].line});
  }
  const Portion filler =
      portion(aggregate * curve.back().passing, design.filler_density.value_or(design.aggregate_density.back()));
  Portion all = coarse;
  (all += fine) += filler;

  const double absorbed = absorbed_of(design, all, out.binder);
  out.absorbed_binder = absorbed / all.mass;
  out.effective_binder = out.binder - absorbed;
  const double solid = all.volume + out.effective_binder / design.binder_density;  // solid volume of 1 kg of mix [m³]
  out.maximum_density = 1 / solid;                                                 // EN 12697-5
  out.air_voids = air_voids_of(design, out.maximum_density);
  out.bulk_density = out.maximum_density * (1 - out.air_voids);
  out.vma = 1 - out.bulk_density * all.volume;  // EN 12697-8; without absorption equal to V_m + B·ρ_bulk/ρ_B
  out.vfb = out.vma > 0 ? (out.vma - out.air_voids) / out.vma : 0;

  for (MixClass& c : out.classes) c.volume *= out.bulk_density;
  const double wet = 1 + out.absorbed_binder;
  out.aggregate_mass = coarse.mass * wet;
  out.aggregate_volume = coarse.volume * out.bulk_density;
  out.aggregate_density = coarse.volume > 0 ? out.aggregate_mass / coarse.volume : 0;
  out.mastic_fine_mass = fine.mass;
  out.mastic_filler_mass = filler.mass;
  out.mastic_binder_mass = out.effective_binder + out.absorbed_binder * (fine.mass + filler.mass);
  out.mastic_mass = fine.mass + filler.mass + out.mastic_binder_mass;
  const double mastic = fine.volume + filler.volume + out.effective_binder / design.binder_density;
  if (!(mastic > 0))
    refuse(design, "binder",
           fmt::format("no mastic: no aggregate passes {} and all binder is absorbed", in_millimetres(design.cut)),
           "more binder, or aggregate finer than the cut");
  out.mastic_volume = mastic * out.bulk_density;
  out.mastic_density = out.mastic_mass / mastic;
  return out;
}

namespace {

/// Moves the volume of every class that has less volume in the box than its smallest grain, a sphere, to the next finer
/// class or, for the finest one, to the next coarser class. The class stays in the list with the volume 0. `solid`:
/// fraction of the box to which the volume fractions refer.
void merge_small_classes(SpecimenSpec& spec, double solid) {
  const auto name = [&](std::size_t k) {
    return fmt::format("{:.6g}-{:.6g} mm", 1e3 * spec.aggregate[k].sieve_min, 1e3 * spec.aggregate[k].sieve_max);
  };
  for (std::size_t k = 0; k < spec.aggregate.size(); ++k) {
    AggregateClass& small = spec.aggregate[k];
    const double smallest = std::numbers::pi / 6 * std::pow(small.sieve_min, 3);
    const double grains = *small.volume_fraction * solid * spec.box.volume() / smallest;
    if (!(grains > 0 && grains < 1 - 1e-12)) continue;
    std::size_t to = k + 1;
    if (to == spec.aggregate.size()) {
      to = k;
      while (to > 0 && *spec.aggregate[to - 1].volume_fraction == 0) --to;
      if (to == 0) continue;  // this class is the only one
      --to;
    }
    *spec.aggregate[to].volume_fraction += *small.volume_fraction;
    small.volume_fraction = 0;
    spec.merged.push_back(
        fmt::format("in this box the volume of the class {} is {:.2g} times the volume of its smallest grain, less "
                    "than one grain, so "
                    "its material is merged with the class {}; a larger box has grains of this class",
                    name(k), grains, name(to)));
  }
}

}  // namespace

void follow(const MixDesign& design, SpecimenSpec& spec) {
  const MixVolumes volumes = volumes_of(design);
  const auto alone = [&](bool wrong, const std::string& found, const std::string& expected) {
    if (wrong) throw InputError(design.source, design.line, "[specimen.recipe]", found, expected);
  };
  alone(!spec.mastic, "no [specimen.mastic]", "[specimen.mastic] with its radii");
  alone(!spec.aggregate.empty(), "classes of aggregate together with the recipe",
        "no classes, because they follow from the recipe");
  alone(spec.mastic->porosity || spec.mastic->count, "a porosity or count of the mastic together with the recipe",
        "neither, because both follow from the recipe");
  alone(spec.voids && spec.voids->count, "a count of voids together with the recipe",
        "a fraction of voids, or neither count nor fraction");
  if (spec.voids && !spec.voids->fraction) spec.voids->fraction = volumes.air_voids;
  const double of_voids = spec.voids ? *spec.voids->fraction : 0;  // fraction of the box
  alone(of_voids > volumes.air_voids + 1e-9,
        fmt::format("voids that are {} of the box, although the mix has only {} of air voids", in_percent(of_voids),
                    in_percent(volumes.air_voids)),
        "a fraction in [specimen.voids] that is at most the air voids of the mix");
  // The mastic's porosity is the air that is not in voids with their own cells. The porosity is given as a fraction of
  // the volume outside of these voids.
  spec.mastic->porosity = (volumes.air_voids - of_voids) / (1 - of_voids);
  for (const MixClass& c : volumes.classes) {
    AggregateClass& out = spec.aggregate.emplace_back();
    out.sieve_min = c.sieve_min, out.sieve_max = c.sieve_max;
    out.volume_fraction = c.volume / (1 - volumes.air_voids);
    out.line = c.line;
  }
  merge_small_classes(spec, 1 - volumes.air_voids);
}

}  // namespace macadam
