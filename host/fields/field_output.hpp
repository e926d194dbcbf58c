// SPDX-License-Identifier: GPL-3.0-or-later
/// \file field_output.hpp  The field files of a run or a specimen, in the folder `fields` of its results.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "macadam/fields.hpp"
#include "macadam/harmonic.hpp"
#include "macadam/simulation.hpp"

namespace macadam {

/// Removes what an older run or specimen left there.
void remove_fields(const std::filesystem::path& out);

/// What the scene asks for of a specimen that nothing has happened to. \throws RunError.
void write_specimen_fields(const Scene& scene, const Preparation& prepared, const std::filesystem::path& out);

/// What a run writes as it goes: nothing where the scene asks for nothing. Scene and preparation must outlive it.
class FieldOutput {
 public:
  /// Writes the cells, if they are asked for: they do not change. \throws RunError.
  FieldOutput(const Scene& scene, const Preparation& prepared, const std::filesystem::path& out);

  /// Begins the series `of` what is stepped ("20Hz"), or goes on with those that are there where the stepper starts at
  /// a time other than 0. A period, or the whole test, has so many samples. Returns a sentence about each series that
  /// should have been there and was not. \throws InputError for a file that is no series of this run.
  std::vector<std::string> begin(const std::string& of, int samples, double time);
  /// Whether the scene asks for a series.
  bool begun() const { return begun_; }
  /// Whether a frame is due at this sample.
  bool wants(std::int64_t sample) const;
  /// Adds a frame. \throws RunError.
  void add(const Stepper& stepper, ContactForm form, Geometry geometry, double time);
  /// After the last frame of what is stepped. \throws RunError.
  void end();

  /// Writes a steady state; laws are those that it was solved with. `temperature` [°C]: where there are several.
  /// \throws RunError.
  void write(const HarmonicResult& solved, const LawTable& laws, std::optional<double> temperature);

 private:
  std::unique_ptr<FieldSeries> series(const char* kind, const std::string& of, FieldMesh mesh, double time,
                                      std::vector<std::string>& missing) const;
  std::filesystem::path stem(const char* kind, const std::string& of) const;

  const Scene& scene_;
  const Preparation& prepared_;
  std::filesystem::path folder_;
  std::unique_ptr<FieldSeries> particles_, contacts_;
  bool writes_;         ///< this process does
  bool begun_ = false;  ///< a series is wanted
  int stride_ = 1;      ///< samples from one frame to the next
};

}  // namespace macadam
