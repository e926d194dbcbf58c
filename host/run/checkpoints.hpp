// SPDX-License-Identifier: GPL-3.0-or-later
/// \file checkpoints.hpp  Decides when checkpoints of a stepped run are written, and checks whether a checkpoint
/// belongs to a run.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "host/files/checkpoint_file.hpp"
#include "macadam/simulation.hpp"
#include "macadam/stepper.hpp"

namespace macadam {

/// The file name of the checkpoint in the folder of the results.
inline constexpr const char* checkpoint_name = "checkpoint.h5";
/// The file name of the previous checkpoint of the same run. The previous checkpoint is used if the newest checkpoint
/// is missing or damaged.
inline constexpr const char* previous_checkpoint_name = "checkpoint-previous.h5";

/// Returns whether runs of this scene keep checkpoints. `why_not` (optional) receives the reason if they do not.
bool keeps_checkpoints(const Scene& scene, Backend backend, std::string* why_not = nullptr);

/// Returns whether a results folder has a checkpoint, the newest or the previous one.
bool has_checkpoint(const std::filesystem::path& folder);

/// A checkpoint from which a run can continue.
struct FoundCheckpoint {
  std::filesystem::path file;
  Checkpoint checkpoint;
  std::string damage;  ///< the fault of the newest checkpoint, if this is the previous one; otherwise empty
};

/// Reads the checkpoint of this scene on this backend from a results folder. If the newest one is missing or damaged,
/// reads the previous one, if that is intact. \throws InputError as read_checkpoint() does for the newest checkpoint;
/// also if the checkpoint belongs to another run. The message then names what differs: scene (with the first different
/// line), version, backend, precision, form or geometry.
FoundCheckpoint find_checkpoint(const std::filesystem::path& folder, const Scene& scene, Backend backend);

/// Returns whether a file is an intact checkpoint of this scene on this backend.
bool is_checkpoint_of(const std::filesystem::path& file, const Scene& scene, Backend backend);

/// Returns the CRC-32 of those data of particles and contacts that the steps use.
std::uint32_t checksum(const Preparation& prepared);

/// Checks that a checkpoint was written for these particles and contacts. \throws InputError if not, for example
/// because the specimen's file was changed since.
void require_same_specimen(const std::filesystem::path& file, const Checkpoint& found, const Preparation& prepared);

/// Removes the arrays of Stepper::state() from a checkpoint and returns them. All other arrays stay in the checkpoint.
std::vector<StateArray> take_state(Checkpoint& from);

/// Adds an experiment's own texts and arrays to a checkpoint.
using Content = std::function<void(Checkpoint& to)>;

/// Writes the checkpoints of one run when they are due. If a checkpoint cannot be written, for example because the disk
/// is full, the user is warned; the previous checkpoint stays, and the run continues.
class Checkpoints {
 public:
  Checkpoints(const std::filesystem::path& file, const Scene& scene, const Preparation& prepared, Backend backend,
              std::function<bool()> stop, std::function<void(const std::string&)> warn, bool resumed);

  /// Writes a checkpoint if one is due or the run must stop. `where` is for messages.
  /// \throws InterruptedError if the run must stop. Its message says that the checkpoint was written, or why it could
  /// not be written.
  void look(const Content& content, const Stepper& stepper, const std::string& where);

  /// Returns whether the file, if it exists, belongs to this run: the run has written it or continues from it.
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
