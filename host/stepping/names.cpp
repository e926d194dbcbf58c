// SPDX-License-Identifier: GPL-3.0-or-later
// names.cpp  Converts the values of stepper options to their names, and lists of device numbers to text.
#include "macadam/backend.hpp"

namespace macadam {

const char* to_string(Backend backend) {
  switch (backend) {
    case Backend::automatic:
      return "auto";
    case Backend::cpu:
      return "cpu";
    case Backend::cuda:
      return "cuda";
    case Backend::reference:
      return "reference";
  }
  return "unknown";
}
const char* to_string(Precision precision) {
  switch (precision) {
    case Precision::double_:
      return "double";
    case Precision::mixed:
      return "mixed";
    case Precision::single:
      return "single";
  }
  return "unknown";
}
const char* to_string(ContactForm form) {
  switch (form) {
    case ContactForm::condensed:
      return "condensed";
    case ContactForm::points:
      return "points";
  }
  return "unknown";
}
const char* to_string(Geometry geometry) {
  switch (geometry) {
    case Geometry::updated:
      return "updated";
    case Geometry::fixed:
      return "fixed";
  }
  return "unknown";
}
const char* to_string(Damping damping) {
  switch (damping) {
    case Damping::none:
      return "none";
    case Damping::local:
      return "local";
    case Damping::viscous:
      return "viscous";
  }
  return "unknown";
}

std::string to_string(const DeviceList& devices) {
  if (devices == DeviceList{every_device}) return "all";
  std::string out;
  for (std::size_t i = 0; i < devices.size(); ++i)
    out += (i == 0 ? "" : i + 1 < devices.size() ? ", " : " and ") + std::to_string(devices[i]);
  return out;
}

}  // namespace macadam
