// SPDX-License-Identifier: GPL-3.0-or-later
// checkpoints.cpp  Decides when a checkpoint is written, and refuses checkpoints that belong to other runs.
#include "host/run/checkpoints.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <new>
#include <sstream>

#include "macadam/error.hpp"
#include "macadam/ranks.hpp"
#include "macadam/version.hpp"

namespace macadam {
namespace {

constexpr const char *specimen_text = "specimen", *state_prefix = "state ";

/// Returns the texts that must be equal in a checkpoint and in the run that continues from it; the specimen is compared
/// separately. Precision, form and geometry are compared as given in the scene. If the scene does not give them, the
/// checkpoint's plan holds the chosen values.
std::map<std::string, std::string> identity(const Scene& scene, Backend backend) {
  const auto asked = [](const auto& choice) { return std::string(choice ? to_string(*choice) : "not given"); };
  return {{"scene", scene.text},
          {"version", version()},
          {"backend", to_string(backend)},
          {"precision", asked(scene.solver.precision)},
          {"form", asked(scene.solver.form)},
          {"geometry", asked(scene.solver.geometry)}};
}

/// Returns a text with the numbers of particles and contacts, and a checksum of those of their data that the steps use.
std::string fingerprint(const Preparation& prepared) {
  const ContactNetwork& n = prepared.network;
  return fmt::format("{} particles, {} contacts, {} contact points, CRC-32 {:08x}", prepared.specimen.size(),
                     n.contacts.size(), n.point_area.size(), checksum(prepared));
}

/// Returns the first line in which two texts differ, as it is in `found` and as it is in `expected`.
std::pair<std::string, std::string> first_difference(const std::string& found, const std::string& expected) {
  std::istringstream a(found), b(expected);
  for (int line = 1;; ++line) {
    std::string left, right;
    const bool more_left = !!std::getline(a, left), more_right = !!std::getline(b, right);
    if (left == right && more_left && more_right) continue;
    const auto shown = [&](bool more, const std::string& text) {
      return more ? fmt::format("line {}: {}", line, text) : fmt::format("no line {}", line);
    };
    return {shown(more_left, left), shown(more_right, right)};
  }
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what, const std::string& found,
                         const std::string& expected) {
  throw InputError(file.string(), 0, "checkpoint of another " + what, found, expected + ", as in this run");
}

/// Checks that a checkpoint belongs to this run: each text of identity() must be the same in the checkpoint. \throws
/// InputError naming the first text that differs.
void require_same_run(const std::filesystem::path& file, const Checkpoint& checkpoint, const Scene& scene,
                      Backend backend) {
  for (const auto& [what, expected] : identity(scene, backend)) {
    const auto there = checkpoint.texts.find(what);
    const std::string found = there == checkpoint.texts.end() ? "" : there->second;
    if (found == expected) continue;
    if (what != "scene") refuse(file, what, found, expected);
    const auto [left, right] = first_difference(found, expected);
    refuse(file, what, left, right);
  }
}

}  // namespace

bool keeps_checkpoints(const Scene& scene, Backend backend, std::string* why_not) {
  const char* why = scene.solver.method == SolverMethod::harmonic ? "method harmonic"
                    : backend == Backend::reference               ? "backend reference"
                    : scene.text.empty()                          ? "a scene that was not read from a file"
                                                                  : nullptr;
  if (why && why_not) *why_not = std::string(why) + " keeps no checkpoints";
  return !why;
}

std::uint32_t checksum(const Preparation& prepared) {
  uLong sum = crc32(0, nullptr, 0);
  const auto add = [&](const auto& list) {
    sum = crc32_z(sum, reinterpret_cast<const Bytef*>(list.data()), list.size() * sizeof(list[0]));
  };
  const Specimen& s = prepared.specimen;
  // voids need not be added, because a change of the voids changes the contacts
  add(s.centre), add(s.radius), add(s.phase), add(s.body);
  const ContactNetwork& n = prepared.network;
  add(n.point_s), add(n.point_t), add(n.point_area);
  std::vector<double> in_series;  // empty unless the network has the rule "series"
  for (std::size_t c = 0; c < n.contacts.size(); ++c) {
    const Contact& contact = n.contacts[c];
    if (contact.length != contact.distance || contact.series != 0)
      in_series.insert(in_series.end(), {static_cast<double>(c), contact.length, contact.series});
  }
  if (!in_series.empty()) add(in_series);
  return static_cast<std::uint32_t>(sum);
}

bool has_checkpoint(const std::filesystem::path& folder) {
  return std::filesystem::exists(folder / checkpoint_name) ||
         std::filesystem::exists(folder / previous_checkpoint_name);
}

bool is_checkpoint_of(const std::filesystem::path& file, const Scene& scene, Backend backend) {
  try {
    require_same_run(file, read_checkpoint(file), scene, backend);
    return true;
  } catch (const InputError&) { return false; }
}

FoundCheckpoint find_checkpoint(const std::filesystem::path& folder, const Scene& scene, Backend backend) {
  FoundCheckpoint out{.file = folder / checkpoint_name, .checkpoint = {}, .damage = {}};
  try {
    out.checkpoint = read_checkpoint(out.file);
  } catch (const InputError& newest) {
    out.file = folder / previous_checkpoint_name;
    out.damage = newest.what();
    try {
      out.checkpoint = read_checkpoint(out.file);
    } catch (const InputError&) { throw newest; }
  }
  require_same_run(out.file, out.checkpoint, scene, backend);
  return out;
}

void require_same_specimen(const std::filesystem::path& file, const Checkpoint& found, const Preparation& prepared) {
  const auto there = found.texts.find(specimen_text);
  const std::string specimen = there == found.texts.end() ? "none" : there->second, here = fingerprint(prepared);
  if (specimen != here) refuse(file, "specimen", specimen, here);
}

std::vector<StateArray> take_state(Checkpoint& from) {
  std::vector<StateArray> out, others;
  for (StateArray& array : from.arrays) {
    const bool state = array.name.starts_with(state_prefix);
    if (state) array.name.erase(0, std::string_view(state_prefix).size());
    (state ? out : others).push_back(std::move(array));
  }
  from.arrays = std::move(others);
  return out;
}

Checkpoints::Checkpoints(const std::filesystem::path& file, const Scene& scene, const Preparation& prepared,
                         Backend backend, std::function<bool()> stop, std::function<void(const std::string&)> warn,
                         bool resumed)
    : file_(file),
      scene_(scene),
      prepared_(prepared),
      backend_(backend),
      stop_(std::move(stop)),
      warn_(std::move(warn)),
      own_(resumed) {}

void Checkpoints::look(const Content& content, const Stepper& stepper, const std::string& where) {
  constexpr double usual = 600;  // [s]
  const double period = scene_.output.checkpoint.value_or(usual);
  std::string why_not;
  const bool kept = keeps_checkpoints(scene_, backend_, &why_not);
  bool stopping = stop_ && stop_();
  bool due = period > 0 && std::chrono::duration<double>(Clock::now() - last_).count() >= period;
  if (Ranks* team = ranks()) stopping = team->any(stopping), due = team->of_first(due) != 0;
  if (!stopping && !(kept && due)) return;
  std::string failure;
  if (kept) {
    try {
      write(content, stepper);
      own_ = true;
    } catch (const RunError& error) { failure = error.what(); } catch (const std::bad_alloc&) {
      failure = "not enough memory";
    }
    last_ = Clock::now();
  }
  if (!stopping && !failure.empty())
    warn_(fmt::format("the checkpoint at {} could not be written: {}", where, failure));
  if (!stopping) return;
  std::string resumable = file_.string() + " is written: the same command with --resume continues from it";
  if (!kept) resumable = "the run cannot be resumed, because " + why_not;
  if (!failure.empty()) {
    const bool older = own_ && std::filesystem::exists(file_);
    resumable = fmt::format("the checkpoint could not be written: {}; {}", failure,
                            older ? "--resume continues from the previous checkpoint" : "the run cannot be resumed");
  }
  throw InterruptedError(fmt::format("interrupted at {}, t = {:.6g} s; {}", where, stepper.observe().time, resumable));
}

void Checkpoints::write(const Content& content, const Stepper& stepper) const {
  // called before the other processes (ranks) return in the next line, because all of them must take part
  std::vector<StateArray> state = stepper.state();
  if (!is_first_rank()) return;
  Checkpoint out;
  out.texts = identity(scene_, backend_);
  out.texts[specimen_text] = fingerprint(prepared_);
  content(out);
  for (StateArray& array : state) {
    array.name = state_prefix + array.name;
    out.arrays.push_back(std::move(array));
  }
  keep_previous();
  write_checkpoint(file_, out);
}

/// Keeps the checkpoint that is about to be replaced, by a hard link with the name of the previous checkpoint. The link
/// is made under a temporary name and then renamed, so that a previous checkpoint exists at every moment. On a file
/// system without hard links, only one checkpoint is kept.
void Checkpoints::keep_previous() const {
  namespace fs = std::filesystem;
  const fs::path previous = file_.parent_path() / previous_checkpoint_name, aside = previous.string() + ".part";
  std::error_code ignored;
  if (!own_) {
    fs::remove(previous, ignored);  // the previous checkpoint in the folder belongs to another run
    return;
  }
  // the link exists already if the previous attempt to write a checkpoint failed
  if (fs::equivalent(file_, previous, ignored)) return;
  fs::remove(aside, ignored);
  std::error_code error;
  fs::create_hard_link(file_, aside, error);
  if (error == std::errc::operation_not_permitted || error == std::errc::operation_not_supported) return;
  if (!error) fs::rename(aside, previous, error);
  if (!error) return;
  fs::remove(aside, ignored);
  warn_(fmt::format("{}: the previous checkpoint cannot be kept: {}", previous.string(), error.message()));
}

}  // namespace macadam
