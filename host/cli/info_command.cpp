// SPDX-License-Identifier: GPL-3.0-or-later
// info_command.cpp  macadam info: version, backends, devices.
#include "host/cli/info_command.hpp"

#include "host/cli/streams.hpp"
#include "macadam/macadam.hpp"

namespace macadam {
namespace {

void info_command() {
  const BackendReport report = report_backends();
  say("macadam {}\n", version());
  say("cpu        yes, {} threads\n", report.threads);
  say("reference  yes, for checking: per point, double, one thread\n");
  say("cuda       {}: {}\n", report.devices.empty() ? "no" : "yes", report.cuda_status);
  for (const DeviceInfo& d : report.devices) {
    say("           {}, compute capability {}.{}, {} multiprocessors, {:.1f} GiB\n", d.name, d.compute_capability / 10,
        d.compute_capability % 10, d.multiprocessors, static_cast<double>(d.memory_bytes) / (1 << 30));
  }
  std::string reason;
  const Backend chosen = select_backend(Backend::automatic, &reason);
  say("auto       {} ({})\n", to_string(chosen), reason);
}

}  // namespace

void add_info_command(CLI::App& app) {
  app.add_subcommand("info", "version, backends and devices")->callback(info_command);
}

}  // namespace macadam
