// SPDX-License-Identifier: GPL-3.0-or-later
/// \file scene_text.hpp  Changes single values in the text of a scene. Comments, order and everything else stay as they
/// are.
#pragma once

#include <filesystem>
#include <string>

#include "macadam/contact_network.hpp"
#include "macadam/specimen.hpp"

namespace macadam::scene {

/// The text of a scene that has been read without errors.
class SceneText {
 public:
  explicit SceneText(std::string text) : text_(std::move(text)) {}

  /// Sets a value in the `[[contacts]]` of a pair. `name` is `delta`, `alpha`, or the key of a modulus or a viscosity;
  /// `E_2` is the second entry of `E`.
  void set_contact(PairType pair, const std::string& name, double value);
  /// Sets a value in the section of a phase in `[materials]`. `name` is the key of a modulus or a viscosity; `E_2` is
  /// the second entry of `E`.
  void set_material(Phase phase, const std::string& name, double value);
  void set_seed(std::uint64_t seed);
  /// Rewrites the paths in the text: paths relative to the folder `from` become paths relative to the folder `to`.
  void move(const std::filesystem::path& from, const std::filesystem::path& to);

  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace macadam::scene
