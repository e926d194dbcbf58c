// SPDX-License-Identifier: GPL-3.0-or-later
// names.cpp  Defines the names of pair types, quadratures and rules in scenes and results. A value that is missing in a
// list of names is an error of the compiler (-Werror=switch).
#include "macadam/contact_network.hpp"

namespace macadam {

const char* to_string(PairType pair) {
  switch (pair) {
    case PairType::mm:
      return "M-M";
    case PairType::ma:
      return "M-A";
    case PairType::aa:
      return "A-A";
    case PairType::inner:
      return "inner";
    case PairType::aw:
      return "A-W";
    case PairType::mw:
      return "M-W";
  }
  return "unknown";
}

const char* to_string(Quadrature quadrature) {
  switch (quadrature) {
    case Quadrature::lumped:
      return "lumped";
    case Quadrature::exact:
      return "exact";
    case Quadrature::one_point:
      return "one_point";
  }
  return "unknown";
}

const char* to_string(ContactRule rule) {
  switch (rule) {
    case ContactRule::centres:
      return "centres";
    case ContactRule::series:
      return "series";
    case ContactRule::volumetric:
      return "volumetric";
  }
  return "unknown";
}

}  // namespace macadam
