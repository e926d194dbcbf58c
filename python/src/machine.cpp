// SPDX-License-Identifier: GPL-3.0-or-later
// machine.cpp  Binds `macadam info`: version, backends and devices.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include "macadam/macadam.hpp"
#include "python/src/bindings.hpp"

namespace macadam::python {
namespace {

namespace nb = nanobind;

#ifdef MACADAM_CT
constexpr bool has_ct = true;
#else
constexpr bool has_ct = false;
#endif

nb::list list_of(const std::vector<DeviceInfo>& devices) {
  nb::list out;
  for (const DeviceInfo& d : devices) {
    nb::dict one;
    one["number"] = d.number;
    one["name"] = d.name;
    one["compute_capability"] = nb::make_tuple(d.compute_capability / 10, d.compute_capability % 10);
    one["memory_bytes"] = d.memory_bytes;
    one["multiprocessors"] = d.multiprocessors;
    out.append(one);
  }
  return out;
}

}  // namespace

void bind_machine(nb::module_& m) {
  m.attr("__version__") = version();
  m.def(
      "info",
      [] {
        const BackendReport report = report_backends();
        std::string reason;
        const Backend chosen = select_backend(Backend::automatic, &reason);
        nb::dict out;
        out["version"] = version();
        out["threads"] = report.threads;
        out["processor"] = report.processor;
        out["cuda"] = report.cuda_status;
        out["devices"] = list_of(report.devices);
        out["devices_without_code"] = list_of(report.devices_without_code);
        out["ct"] = has_ct;
        out["auto"] = to_string(chosen);
        out["auto_reason"] = reason;
        return out;
      },
      "Returns version, backends and devices: `macadam info`.");
}

}  // namespace macadam::python
