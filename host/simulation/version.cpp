// SPDX-License-Identifier: GPL-3.0-or-later
// version.cpp  The version is the project's, from CMakeLists.txt.
#include "macadam/version.hpp"

namespace macadam {

const char* version() { return MACADAM_VERSION; }

}  // namespace macadam
