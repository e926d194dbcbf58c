// SPDX-License-Identifier: GPL-3.0-or-later
/// \file scene_text.hpp  Changes of single values in the text of a scene; comments, order and all else stay.
#pragma once

#include <filesystem>
#include <string>

#include "macadam/contact_network.hpp"

namespace macadam::scene {

/// A scene that was read, as text.
class SceneText {
 public:
  explicit SceneText(std::string text) : text_(std::move(text)) {}

  /// A key of a pair's `[[contacts]]`: `delta`, `alpha`, a modulus or a viscosity; `E_2` is the second entry of `E`.
  void set_contact(PairType pair, const std::string& name, double value);
  void set_seed(std::uint64_t seed);
  /// Paths are relative to a scene's folder; these are those of the folder `to`.
  void move(const std::filesystem::path& from, const std::filesystem::path& to);

  const std::string& text() const { return text_; }

 private:
  void replace(std::size_t begin, std::size_t end, const std::string& by) { text_.replace(begin, end - begin, by); }

  std::string text_;
};

}  // namespace macadam::scene
