// SPDX-License-Identifier: GPL-3.0-or-later
/// \file checkpoints.hpp  Where a stepped run stands, when it is written down, and to which run that belongs.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "host/results/checkpoint.hpp"
#include "macadam/simulation.hpp"
#include "macadam/stepper.hpp"

namespace macadam {

/// The checkpoint's name in the folder of the results.
inline constexpr const char* checkpoint_name = "checkpoint.h5";
/// The one before it, of the same run, for where the newest is damaged on the disk.
inline constexpr const char* previous_checkpoint_name = "checkpoint-previous.h5";

/// Whether runs of this scene keep checkpoints; `why_not` (optional) says why they do not.
bool keeps_checkpoints(const Scene& scene, Backend backend, std::string* why_not = nullptr);

/// Whether a folder of results has a checkpoint, or the one before.
bool has_checkpoint(const std::filesystem::path& folder);

/// What a run can go on from.
struct FoundCheckpoint {
  std::filesystem::path file;
  Checkpoint checkpoint;
  std::string damage;  ///< what is wrong with the newest, where this is the one before; else empty
};

/// Reads the checkpoint of this scene on this backend, which belongs to one of its tests, from a folder of results:
/// where the newest is missing or damaged, the one before, if that is whole.
/// \throws InputError as read_checkpoint() of the newest, and naming what differs: scene (with the first line that
/// does), version, backend, precision, form or geometry.
FoundCheckpoint find_checkpoint(const std::filesystem::path& folder, const Scene& scene, Backend backend);

/// Whether a file is a whole checkpoint of this scene on this backend.
bool is_checkpoint_of(const std::filesystem::path& file, const Scene& scene, Backend backend);

/// CRC-32 of all that the steps take from particles and contacts.
std::uint32_t checksum(const Preparation& prepared);

/// \throws InputError when the checkpoint's particles and contacts were others (its specimen file was changed).
void require_same_specimen(const std::filesystem::path& file, const Checkpoint& found, const Preparation& prepared);

/// Stepper::state() out of a checkpoint, whose other arrays stay.
std::vector<StateArray> take_state(Checkpoint& from);

/// A test's own part of a checkpoint: adds its texts and arrays.
using Content = std::function<void(Checkpoint& to)>;

/// Writes checkpoints of one run where they are due. One that cannot be written (a full disk) is a warning: the one
/// before it stays, and the run goes on.
class Checkpoints {
 public:
  Checkpoints(const std::filesystem::path& file, const Scene& scene, const Preparation& prepared, Backend backend,
              std::function<bool()> stop, std::function<void(const std::string&)> warn, bool resumed);

  /// Looks whether it is time or the run is to stop; `where` is for the message.
  /// \throws InterruptedError when it was to stop, with the checkpoint written, or why it could not be.
  void look(const Content& content, const Stepper& stepper, const std::string& where);

  /// Whether the file, if it is there, is this run's: it was written, or the run goes on from it.
  bool own() const { return own_; }

 private:
  void write(const Content& content, const Stepper& stepper) const;
  void keep_previous() const;

  using Clock = std::chrono::steady_clock;
  std::filesystem::path file_;
  const Scene& scene_;
  const Preparation& prepared_;
  Backend backend_;
  std::function<bool()> stop_;
  std::function<void(const std::string&)> warn_;
  bool own_;
  Clock::time_point last_ = Clock::now();
};

}  // namespace macadam
