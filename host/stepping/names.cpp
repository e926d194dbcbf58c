// SPDX-License-Identifier: GPL-3.0-or-later
// names.cpp  Converts the values of stepper options to their names, and lists of device numbers to text.
#include "macadam/backend.hpp"

namespace macadam {

const char* to_string(Backend b) {
  switch (b) {
    case Backend::cpu:
      return "cpu";
    case Backend::cuda:
      return "cuda";
    case Backend::reference:
      return "reference";
    default:
      return "auto";
  }
}
const char* to_string(Precision p) {
  switch (p) {
    case Precision::mixed:
      return "mixed";
    case Precision::single:
      return "single";
    default:
      return "double";
  }
}
const char* to_string(ContactForm f) { return f == ContactForm::points ? "points" : "condensed"; }
const char* to_string(Geometry g) { return g == Geometry::fixed ? "fixed" : "updated"; }
const char* to_string(Damping d) { return d == Damping::none ? "none" : d == Damping::local ? "local" : "viscous"; }

std::string to_string(const DeviceList& devices) {
  if (devices == DeviceList{every_device}) return "all";
  std::string out;
  for (std::size_t i = 0; i < devices.size(); ++i)
    out += (i == 0 ? "" : i + 1 < devices.size() ? ", " : " and ") + std::to_string(devices[i]);
  return out;
}

}  // namespace macadam
