// SPDX-License-Identifier: GPL-3.0-or-later
/// \file all.hpp  Includes all drives that come with Macadam.
#pragma once

#include "macadam/drives/constant_rate.hpp"
#include "macadam/drives/cyclic.hpp"
#include "macadam/drives/haversine.hpp"
#include "macadam/drives/ramp.hpp"
#include "macadam/drives/table.hpp"
