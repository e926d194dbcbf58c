// SPDX-License-Identifier: GPL-3.0-or-later
// read_analogue.cpp  Reads the constants of 2S2P1D or Huet–Sayegh from a small TOML file.
#include <fmt/format.h>

#include "host/scene/sections.hpp"
#include "host/scene/shift_keys.hpp"
#include "macadam/fit.hpp"

namespace macadam {

ShiftedAnalogue read_analogue(const std::filesystem::path& file) {
  using namespace scene;
  std::string text;
  const toml::table table = read_toml(file, "model", text);
  const Section section(file.string(), 0, "", "", table);
  constexpr Rule exponent{[](double v) { return v > 0 && v < 1; }, "a number between 0 and 1"};
  AnalogueModel m;
  std::size_t kind = 0;
  ShiftKeys shift;
  std::vector<Key> keys{{"model", Need::required,
                         [&](const Value& v) {
                           kind = v.choice({"2s2p1d", "huet_sayegh"});
                         }},
                        {"E_0", Need::required, into(m.E_0, modulus, positive)},
                        {"E_00", Need::optional, into(m.E_00, modulus, non_negative)},
                        {"k", Need::required, into(m.k, ratio, exponent)},
                        {"h", Need::required, into(m.h, ratio, exponent)},
                        {"delta", Need::required, into(m.delta, ratio, positive)},
                        {"tau", Need::required, into(m.tau, duration, positive)},
                        {"beta", Need::optional, into(m.beta, ratio, positive)}};
  for (Key& key : shift.keys()) keys.push_back(std::move(key));
  section.read(keys);
  if (m.E_00 >= m.E_0) section.refuse("E_00", fmt::format("{}", m.E_00), fmt::format("less than E_0, {}", m.E_0));
  if (m.k >= m.h) section.refuse("k", fmt::format("{}", m.k), fmt::format("less than h, {}", m.h));
  if ((kind == 0) != section.has("beta")) {
    section.refuse("beta", kind == 0 ? "nothing" : "this key",
                   kind == 0 ? "this key, because the model is \"2s2p1d\""
                             : "no beta, because the model huet_sayegh has no dashpot");
  }
  return {m, shift.shift(section)};
}

}  // namespace macadam
