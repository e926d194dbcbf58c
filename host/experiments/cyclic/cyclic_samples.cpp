// SPDX-License-Identifier: GPL-3.0-or-later
// cyclic_samples.cpp  Takes the samples of a frequency of a stepped cyclic test: strain and stress, broken contact
// points and the lateral strain.
#include <fmt/format.h>

#include <algorithm>

#include "host/experiments/cyclic/cyclic_steps.hpp"

namespace macadam {
namespace {

/// Number of times per cycle at which broken contact points are counted. Reading them takes longer than a step.
constexpr std::int64_t looks_per_cycle = 50;
/// Least number of times per cycle at which the lateral strain is measured, if there are so many samples. The fit needs
/// 16; copying the displacements takes longer than a step on a device.
constexpr std::int64_t lateral_per_cycle = 20;

/// Returns the number of samples from one measurement of the lateral strain to the next. It divides the samples of a
/// cycle, so that the measurements of a cycle are evenly spaced.
std::int64_t between_lateral(std::int64_t per_cycle) {
  std::int64_t out = std::max<std::int64_t>(1, per_cycle / lateral_per_cycle);
  while (per_cycle % out != 0) --out;
  return out;
}

}  // namespace

std::string response_line(const ResponseSample& s) {
  return fmt::format("{},{},{},{}", s.frequency_hz, s.time_s, s.strain, s.stress_pa);
}

void CyclicSteps::begin_cracks(const std::filesystem::path& out) {
  if (!counts_cracks(scene_)) return;
  cracks_writer_.emplace(out / cracks_file, "frequency_hz," + crack_head(can_crack(facts_of(scene_.laws))));
  for (std::size_t i = 0; i < at_.cracks.size(); ++i) write_cracks(i, at_.cracks[i].events);
}

void CyclicSteps::write_cracks(std::size_t i, const std::vector<experiments::CrackEvent>& events) {
  for (const experiments::CrackEvent& event : events) {
    cracks_writer_->add(fmt::format("{},{}", at_.plan.frequencies[i].loading.frequency,
                                    crack_line(prepared_, event, can_crack(facts_of(scene_.laws)))));
  }
}

void CyclicSteps::look_for_cracks(std::size_t i, CrackWatch& watch, const Observation& now) {
  FrequencyCracks& cracks = at_.cracks[i];
  read_contact_state(scene_, *stepper_, prepared_.network, contact_state_);
  write_cracks(i, watch.look(contact_state_, now.time));
  cracks.events = watch.found().events;
  const double strain = now.top_displacement() / gauge_length(prepared_.specimen);
  if (strain > 0 && !watch.joins_walls()) cracks.rupture = {now.time, strain, cracks.time_s, cracks.strain};
  cracks.time_s = now.time, cracks.strain = strain;
}

void CyclicSteps::warn_of_cracks(std::size_t i, const experiments::Cracks& found, RunResult& result) {
  const std::string name = fmt::format("{} Hz", at_.plan.frequencies[i].loading.frequency);
  if (const auto& rupture = at_.cracks[i].rupture) {
    warn(fmt::format("{}: {} |E*| and phi could not be measured.", name, rupture_words(*rupture)), result);
  } else if (found.points() > 0) {
    warn(fmt::format("{}: {}", name, cracks_words(found)), result);
  }
}

Course CyclicSteps::course_of(std::size_t i, LineWriter* writer, CrackWatch& cracks, const Content& content) {
  const FrequencyPlan& p = at_.plan.frequencies[i];
  const std::int64_t per_cycle = at_.plan.samples_per_cycle, per_period = p.loading.steps_per_period;
  const std::int64_t stride = per_period / per_cycle;
  // The modulus of each cycle is a result if increments follow cracks; then all cycles are stored
  const bool all = writer || (is_quasi_static() && cracks.active());
  const std::int64_t kept = all ? 0 : std::int64_t{std::max(0, p.cycles - p.fit_cycles - 1)} * per_cycle;
  Course course;
  course.name = fmt::format("{} Hz", p.loading.frequency);
  course.dt = p.loading.dt();
  course.frequency = p.loading.frequency;
  course.first = (stepper_->observe().step + stride - 1) / stride;
  course.last = p.cycles * per_cycle;
  course.step_of = [stride](std::int64_t k) { return k * stride; };
  const std::int64_t between_looks = std::max<std::int64_t>(1, per_cycle / looks_per_cycle);
  const auto looks = [=, active = cracks.active()](std::int64_t k) {
    return active && (k % between_looks == 0 || k % per_cycle == 0);
  };
  // the lateral strain is measured only in the cycles that are fitted
  const std::int64_t lateral_from = course.last - p.fit_cycles * per_cycle, between = between_lateral(per_cycle);
  const auto has_lateral = [=, last = course.last, known = sides_.has_value()](std::int64_t k) {
    return known && k > lateral_from && (last - k) % between == 0;
  };
  course.uses_stepper = [=](std::int64_t k) { return looks(k) || has_lateral(k); };
  course.ended = [this, i] { return at_.cracks[i].rupture.has_value(); };
  course.taken = [=](std::int64_t k) { return k >= kept || k % per_cycle == 0 || looks(k); };
  course.take = [=, this, &p, &cracks](std::int64_t k, const Observation& now) {
    if (looks(k)) look_for_cracks(i, cracks, now);
    if (k < kept) return;
    const Specimen& specimen = prepared_.specimen;
    // in tension the particles pull the top wall down, so the force on the wall is negative
    at_.samples.push_back({p.loading.frequency, now.time, now.top_displacement() / gauge_length(specimen),
                           -now.top_force() / section_area(specimen)});
    if (has_lateral(k)) at_.samples.back().lateral_strain = lateral_strain();
    if (writer) writer->add(response_line(at_.samples.back()));
  };
  course.shown = [=, this, &p](std::int64_t step, double steps_a_second) {
    if (is_quasi_static())
      return fmt::format("{} Hz ({} of {}), cycle {:.2f} of {}", p.loading.frequency, i + 1,
                         at_.plan.frequencies.size(), static_cast<double>(step) / static_cast<double>(per_period),
                         p.cycles);
    return fmt::format("{} Hz ({} of {}), cycle {:.2f} of {}, {:.0f} steps/s", p.loading.frequency, i + 1,
                       at_.plan.frequencies.size(), static_cast<double>(step) / static_cast<double>(per_period),
                       p.cycles, steps_a_second);
  };
  course.content = content;
  return course;
}

double CyclicSteps::lateral_strain() const {
  return -sides_->contraction(stepper_->motions(sides_->particles())) / gauge_length(prepared_.specimen);
}

}  // namespace macadam
