// SPDX-License-Identifier: GPL-3.0-or-later
// calibrate_command.cpp  Implements `macadam calibrate SCENE --target lab.csv --free M-A.delta,M-M.delta --out DIR`.
#include "host/cli/tool_commands/calibrate_command.hpp"

#include <fmt/format.h>

#include <charconv>
#include <memory>

#include "host/cli/terminal/draw_results.hpp"
#include "host/cli/terminal/help.hpp"
#include "host/cli/terminal/job.hpp"
#include "host/cli/terminal/options.hpp"
#include "host/cli/terminal/stop_signals.hpp"
#include "host/cli/terminal/streams.hpp"
#include "host/tools/fit/fit_files.hpp"
#include "macadam/calibration.hpp"
#include "macadam/error.hpp"

namespace macadam {
namespace {

struct CalibrateArguments {
  Job job;
  std::string target;
  std::vector<std::string> free, bounds, priors;
  std::optional<Backend> backend;
  std::optional<int> threads;
  double e_star_deviation = 3;  // %
  bool no_pictures = false;
  CalibrationOptions options;
};

/// A free parameter and two numbers, from the text "NAME=A:B".
struct Pair {
  FreeParameter* parameter;
  double first, second;
};

Pair pair_of(const std::string& option, const std::string& text, std::vector<FreeParameter>& free,
             const std::string& form) {
  const auto refuse = [&](const std::string& expected) {
    throw InputError("command line", 0, option, '"' + text + '"', expected);
  };
  const std::size_t equals = text.find('='), colon = text.find(':', equals == std::string::npos ? 0 : equals);
  if (equals == std::string::npos || colon == std::string::npos) refuse(form);
  Pair out{nullptr, 0, 0};
  for (FreeParameter& p : free)
    if (p.name == text.substr(0, equals)) out.parameter = &p;
  if (!out.parameter) refuse(form + ", where NAME is one of the parameters in --free");
  const auto number = [&](std::size_t begin, std::size_t end, double& value) {
    const auto [stop, error] = std::from_chars(text.data() + begin, text.data() + end, value);
    if (error != std::errc{} || stop != text.data() + end) refuse(form);
  };
  number(equals + 1, colon, out.first);
  number(colon + 1, text.size(), out.second);
  return out;
}

void read_parameters(CalibrateArguments& arguments) {
  std::vector<FreeParameter>& free = arguments.options.free;
  for (const std::string& name : arguments.free) free.push_back({name, {}, {}, {}, 0});
  for (const std::string& text : arguments.bounds) {
    const Pair p = pair_of("--bounds", text, free, "NAME=LOW:HIGH");
    if (p.parameter->low)
      throw InputError("command line", 0, "--bounds", p.parameter->name + " twice", "each parameter once");
    p.parameter->low = p.first, p.parameter->high = p.second;
  }
  for (const std::string& text : arguments.priors) {
    const Pair p = pair_of("--prior", text, free, "NAME=VALUE:DEVIATION");
    if (p.parameter->prior)
      throw InputError("command line", 0, "--prior", p.parameter->name + " twice", "each parameter once");
    p.parameter->prior = p.first, p.parameter->prior_deviation = p.second;
  }
}

void calibrate_command(CalibrateArguments arguments) {
  read_parameters(arguments);
  arguments.options.e_star_deviation = arguments.e_star_deviation / 100;
  Scene scene = scene_of(arguments.job);
  const ModulusData data = read_modulus_data(arguments.target, {}, measured_for(arguments.options.misfit));
  if (arguments.threads) scene.solver.threads = *arguments.threads;
  if (arguments.backend) {
    scene.solver.backend = *arguments.backend;
    if (scene.solver.backend == Backend::cpu) scene.solver.devices.clear();
  }
  const std::filesystem::path out = arguments.job.out;
  ProgressLine line;
  Watcher watcher;
  watcher.progress = [&](const std::string& stage, double share) { show_or_stop(line, stage, share); };
  watcher.stop = stop_asked;
  listen_to_stop_signals();
  const Calibration calibration = calibrate_into(out, scene, data, arguments.options, watcher);
  line.clear();
  say("{}{}", unused_columns_text(data), calibration_text(calibration));
  for (const std::string& warning : calibration.warnings) say("warning: {}\n", warning);
  say("files in {}: scene.toml calibration.json predicted.csv\n", arguments.job.out);
  if (!arguments.no_pictures) say("{}", draw_results("draw-calibration", out, "calibration.png"));
}

}  // namespace

void add_calibrate_command(CLI::App& app) {
  CLI::App& command =
      *app.add_subcommand("calibrate", "find parameters of a scene from measured moduli of the mixture");
  const auto arguments = std::make_shared<CalibrateArguments>();
  CalibrationOptions& options = arguments->options;
  add_job_options(command, arguments->job);
  add_text(command, "--target", arguments->target,
           "CSV file of measured moduli with the columns frequency_hz, e_star_pa or e_star_mpa, phase_deg (or "
           "e_prime_pa, e_double_prime_pa), optionally temperature_c, e_star_std, phase_std")
      ->required();
  command
      .add_option("--free", arguments->free,
                  "parameters to find, separated by commas, such as M-A.delta,M-M.E_1,inner.E,A-A.alpha")
      ->delimiter(',')
      ->required()
      ->type_name("NAME");
  command
      .add_option(
          "--bounds", arguments->bounds,
          "limits of parameters, separated by commas; default: four decades below and above the value in the scene")
      ->delimiter(',')
      ->type_name("NAME=LOW:HIGH");
  command
      .add_option(
          "--prior", arguments->priors,
          "values known beforehand, separated by commas; DEVIATION is the standard deviation of the natural logarithm "
          "(0.1: about 10 %)")
      ->delimiter(',')
      ->type_name("NAME=VALUE:DEVIATION");
  add_number(
      command, "--seeds", options.seeds,
      "number of specimens whose E* is averaged; the first has the seed of the scene, each next one the next seed", 1,
      1000);
  add_choice(command, "--misfit", options.misfit, "the differences that are minimised; parts: E' and E''",
             {{"modulus-and-phase", Misfit::modulus_and_phase},
              {"modulus", Misfit::modulus},
              {"phase", Misfit::phase},
              {"parts", Misfit::parts}});
  add_number(command, "--e-star-deviation", arguments->e_star_deviation,
             "standard deviation of |E*| in %, if the file has no e_star_std", 1e-6, 100.0);
  add_number(command, "--phase-deviation", options.phase_deviation,
             "standard deviation of the phase angle in degrees, if the file has no phase_std", 1e-6, 90.0);
  command.add_flag("--nearest", options.nearest,
                   "if no values of the parameters reach the targets, write the nearest values and a warning");
  add_choice(command, "--backend", arguments->backend, "device that computes: auto is a CUDA device if there is one",
             {{"auto", Backend::automatic}, {"cuda", Backend::cuda}, {"cpu", Backend::cpu}})
      ->group(instead_of_scene);
  add_number(command, "--threads", arguments->threads, "number of CPU threads; results do not depend on it", 1, 1024)
      ->group(instead_of_scene);
  command.add_flag("--no-pictures", arguments->no_pictures, "draw no pictures");
  for (const char* name : {"--misfit", "--e-star-deviation", "--phase-deviation", "--seeds", "--nearest"})
    command.get_option(name)->group("What is fitted");
  add_examples(command,
               {"macadam calibrate examples/aggregate_cube/scene.toml --target examples/aggregate_cube/rock.csv "
                "--free inner.E --out results/inner"});
  command.callback([arguments] { calibrate_command(*arguments); });
}

}  // namespace macadam
