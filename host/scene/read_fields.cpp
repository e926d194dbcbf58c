// SPDX-License-Identifier: GPL-3.0-or-later
/// \file read_fields.cpp  Reads the keys of `[output]` that ask for fields.
#include <array>

#include <fmt/format.h>

#include "host/scene/sections.hpp"

namespace macadam::scene {

std::vector<Key> keys_of(FieldSpec& spec) {
  constexpr std::int64_t most_samples = 1'000'000'000;
  const auto read_list = [&spec](const Value& value) {
    const std::array<bool*, 3> asked{&spec.particles, &spec.contacts, &spec.cells};
    for (const Value& entry : value.entries("an array of \"particles\", \"contacts\", \"cells\"")) {
      bool& one = *asked[entry.choice({"particles", "contacts", "cells"})];
      if (one) entry.refuse(entry.shown() + " twice", "each field once");
      one = true;
    }
  };
  return {{"fields",
           Need::optional,
           {read_list, {"list", nullptr, "", "", {"particles", "contacts", "cells"}}},
           "fields that are written for ParaView",
           "none"},
          {"every", Need::optional, into(spec.every, 1, most_samples),
           "number of samples between two frames of a stepped run", "a twentieth of all samples"},
          {"format", Need::optional,
           into<FieldFormat>(spec.format, {{"vtkhdf", FieldFormat::vtkhdf}, {"vtp", FieldFormat::vtp}}),
           "file format of the fields: one HDF5 file per series, or one XML file per frame"}};
}

void check_fields(const Section& section, const FieldSpec& spec) {
  if (spec.any()) return;
  for (const char* key : {"every", "format"}) {
    if (const auto value = section.find(key)) {
      value->refuse(value->shown() + " without the key fields",
                    "also a key such as fields = [\"particles\"], or no key " + std::string(key));
    }
  }
}

}  // namespace macadam::scene
