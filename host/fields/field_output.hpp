// SPDX-License-Identifier: GPL-3.0-or-later
/// \file field_output.hpp  Writes the field files of a run or a specimen into the folder `fields` of its results.
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

/// Removes the field files of an older run or specimen.
void remove_fields(const std::filesystem::path& out);

/// Writes the fields that the scene asks for, of a specimen that has not been loaded. \throws RunError.
void write_specimen_fields(const Scene& scene, const Preparation& prepared, const std::filesystem::path& out);

/// Writes the fields of a run while the run advances; writes nothing if the scene requests no fields. Scene and
/// preparation must outlive this object.
class FieldOutput {
 public:
  /// Writes the Laguerre cells if the scene requests them. The cells do not change during a run. \throws RunError.
  FieldOutput(const Scene& scene, const Preparation& prepared, const std::filesystem::path& out);

  /// Begins the series of fields of a stepped run. `of` is the name of this part of the run in file names, for example
  /// "20Hz". If the stepper starts at a `time` other than 0, the existing series are continued. `samples` is the number
  /// of samples per period of a cyclic test, or the number of samples of any other test. Returns a sentence about each
  /// series that should have existed but did not. \throws InputError for a file that is not a series of this run.
  std::vector<std::string> begin(const std::string& of, int samples, double time);
  /// Returns whether the scene requests a series of fields.
  bool begun() const { return begun_; }
  /// Returns whether a frame is due at this sample.
  bool wants(std::int64_t sample) const;
  /// Adds a frame. \throws RunError.
  void add(const Stepper& stepper, ContactForm form, Geometry geometry, double time);
  /// Closes the series after the last frame. \throws RunError.
  void end();

  /// Writes a steady state. `laws` are the laws with which the steady state was solved. `temperature` [°C] must be
  /// given if there are several temperatures; it becomes a part of the file name. \throws RunError.
  void write(const HarmonicResult& solved, const LawTable& laws, std::optional<double> temperature);

 private:
  std::unique_ptr<FieldSeries> series(const char* kind, const std::string& of, FieldMesh mesh, double time,
                                      std::vector<std::string>& missing) const;
  std::filesystem::path stem(const char* kind, const std::string& of) const;

  const Scene& scene_;
  const Preparation& prepared_;
  std::filesystem::path folder_;
  std::unique_ptr<FieldSeries> particles_, contacts_, cracks_;
  bool writes_;         ///< whether this process writes the files: only the first rank does
  bool begun_ = false;  ///< whether the scene requests a series of fields
  int stride_ = 1;      ///< samples from one frame to the next
};

}  // namespace macadam
