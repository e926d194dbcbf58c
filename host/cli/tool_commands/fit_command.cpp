// SPDX-License-Identifier: GPL-3.0-or-later
// fit_command.cpp  Implements `macadam fit DATA.csv --out DIR`; `--parameters MODEL.toml` may replace the data.
#include "host/cli/tool_commands/fit_command.hpp"

#include <fmt/format.h>

#include <memory>

#include "host/cli/terminal/draw_results.hpp"
#include "host/cli/terminal/help.hpp"
#include "host/cli/terminal/options.hpp"
#include "host/cli/terminal/streams.hpp"
#include "host/tools/fit/fit_files.hpp"
#include "macadam/error.hpp"
#include "macadam/fit.hpp"

namespace macadam {
namespace {

struct FitArguments {
  std::string data, parameters, out;
  std::optional<double> poisson, from, to;
  double error = 0.01;
  bool flow = false, no_flow = false, no_pictures = false, curve = false;
  FitOptions fit;
};

/// Refuses options that have no effect together with the other options, because the user would expect an effect.
/// \throws InputError
void require_uses(const CLI::App& command, const FitArguments& arguments) {
  const auto refuse = [&](const std::string& found, const char* expected, std::initializer_list<const char*> names) {
    for (const char* name : names)
      if (command.count(name) > 0) throw InputError("command line", 0, name, found, expected);
  };
  const FitModel model = arguments.fit.model;
  if (!arguments.parameters.empty())
    refuse("this option together with --parameters", "this option only with a CSV file of measurements",
           {"--model", "--units", "--most-units", "--criterion", "--flow", "--no-flow", "--poisson", "--shift",
            "--reference-temperature", "--curve"});
  else if (arguments.curve)
    refuse("this option together with --curve", "only one of the two options, because --curve chooses the chain itself",
           {"--model", "--units", "--most-units", "--criterion", "--flow", "--no-flow", "--shift",
            "--reference-temperature", "--from", "--to", "--error"});
  else if (model == FitModel::kelvin)
    refuse("this option with model kelvin",
           "this option only with --model 2s2p1d or huet-sayegh, from which a Kelvin chain is computed",
           {"--from", "--to", "--error"});
  else
    refuse(std::string("this option with model ") + (model == FitModel::two_s2p1d ? "2s2p1d" : "huet-sayegh"),
           "this option only with --model kelvin", {"--units", "--most-units", "--criterion", "--flow", "--no-flow"});
  if (arguments.fit.units) {
    refuse("this option together with --units", "only one of the two options", {"--most-units"});
    if (arguments.flow || arguments.no_flow)
      refuse("this option together with --units and --flow or --no-flow",
             "a command without this option, because nothing is left to choose", {"--criterion"});
  }
}

/// Converts a model that was fitted elsewhere into a Kelvin chain. Called if the command line has no data.
void convert(const FitArguments& arguments) {
  const ShiftedAnalogue analogue = read_analogue(arguments.parameters);
  const FitReport report = report_conversion(analogue, arguments.from, arguments.to, arguments.error);
  write_report(arguments.out, report);
  say("{}", report.text);
  say("files in {}: law.toml\n", arguments.out);
}

/// Writes the Kelvin chain that approximates a computed curve of moduli.
void stand_for(const ModulusData& curve, const std::string& out) {
  const FitReport report = report_of(chain_of_curve(curve), curve);
  write_report(out, report);
  say("{}{}", unused_columns_text(curve), report.text);
  say("files in {}: law.toml\n", out);
}

void fit_command(const CLI::App& command, FitArguments arguments) {
  if (arguments.data.empty() == arguments.parameters.empty()) {
    throw InputError("command line", 0, "what to fit",
                     arguments.data.empty() ? "nothing" : "both data and --parameters",
                     "a CSV file of measurements, or --parameters with a model's TOML file");
  }
  require_uses(command, arguments);
  if (arguments.data.empty()) return convert(arguments);
  if (arguments.flow || arguments.no_flow) arguments.fit.flow = arguments.flow;
  const ModulusData data = read_modulus_data(arguments.data, arguments.poisson);
  if (arguments.curve) return stand_for(data, arguments.out);
  const Fit fit = fit_modulus(data, arguments.fit);
  const FitReport report = report_of(fit, arguments.from, arguments.to, arguments.error);
  const std::filesystem::path out = arguments.out;
  write_report(out, report);
  say("{}{}", unused_columns_text(data), report.text);
  for (const std::string& warning : fit.warnings) say("warning: {}\n", warning);
  say("files in {}: {}fit.json fit.csv curve.csv\n", arguments.out, report.refusal.empty() ? "law.toml " : "");
  if (!arguments.no_pictures) { say("{}", draw_results("draw-fit", out, "master-curve.png cole-cole.png black.png")); }
  if (!report.refusal.empty()) throw InputError(report.refusal);
}

}  // namespace

void add_fit_command(CLI::App& app) {
  CLI::App& command = *app.add_subcommand("fit", "fit a contact law to measured complex moduli");
  const auto arguments = std::make_shared<FitArguments>();
  FitOptions& fit = arguments->fit;
  command
      .add_option("data", arguments->data,
                  "CSV file of measured moduli with the columns frequency_hz, e_star_pa, e_star_mpa or g_star_pa, "
                  "phase_deg, optionally temperature_c, e_star_std, phase_std")
      ->type_name("FILE");
  add_out(command, arguments->out);
  command.add_flag("--no-pictures", arguments->no_pictures, "draw no pictures");
  add_choice(command, "--model", fit.model, "model to fit",
             {{"kelvin", FitModel::kelvin}, {"2s2p1d", FitModel::two_s2p1d}, {"huet-sayegh", FitModel::huet_sayegh}});
  add_number(command, "--units", fit.units,
             "number of Kelvin units; without this option --criterion chooses the number", 0,
             laws::GeneralisedKelvin::max_units);
  add_number(command, "--most-units", fit.most_units, "largest number of Kelvin units that the criterion may choose", 0,
             laws::GeneralisedKelvin::max_units);
  add_choice(command, "--criterion", fit.criterion, "information criterion that chooses the number of Kelvin units",
             {{"aicc", Criterion::aicc}, {"bic", Criterion::bic}});
  auto* flow =
      command.add_flag("--flow", arguments->flow, "always use a dashpot in series, whatever --criterion would choose");
  command.add_flag("--no-flow", arguments->no_flow, "never use a dashpot in series, whatever --criterion would choose")
      ->excludes(flow);
  add_choice(command, "--shift", fit.shift, "law by which temperature shifts the curves",
             {{"none", ShiftKind::none},
              {"wlf", ShiftKind::wlf},
              {"arrhenius", ShiftKind::arrhenius},
              {"free", ShiftKind::free}});
  add_number(command, "--reference-temperature", fit.reference_temperature,
             "temperature at which a_T is 1 [degrees Celsius]; default: the middle one of the measured temperatures",
             -273.0, 1000.0);
  add_number(command, "--poisson", arguments->poisson,
             "Poisson's ratio with which |E*| is computed from the column g_star_pa", -0.99, 0.5);
  add_text(command, "--parameters", arguments->parameters,
           "TOML file of a 2S2P1D or Huet-Sayegh model to convert into a Kelvin chain, in place of measured data");
  add_number(command, "--from", arguments->from,
             "lowest frequency of the Kelvin chain [Hz]; default: the lowest measured frequency", 1e-15, 1e15);
  add_number(command, "--to", arguments->to,
             "highest frequency of the Kelvin chain [Hz]; default: the highest measured frequency", 1e-15, 1e15);
  add_number(command, "--error", arguments->error, "largest relative error of the Kelvin chain's |E*|", 1e-6, 0.5);
  command.add_flag("--curve", arguments->curve,
                   "treat the moduli as a computed curve, such as sweep.csv, and write only a Kelvin chain of up to 16 "
                   "units that approximates this curve, fitted to a 2S2P1D model of the curve or to its points");
  const std::string model = "The model", temperatures = "Temperatures", chain = "The Kelvin chain of another model";
  for (const char* name : {"--model", "--units", "--most-units", "--criterion", "--flow", "--no-flow", "--poisson"})
    command.get_option(name)->group(model);
  for (const char* name : {"--shift", "--reference-temperature"}) command.get_option(name)->group(temperatures);
  for (const char* name : {"--parameters", "--from", "--to", "--error"}) command.get_option(name)->group(chain);
  add_examples(command, {"macadam fit examples/laws/mastic.csv --out results/law",
                         "macadam fit examples/laws/mastic.csv --out results/law --model 2s2p1d --shift wlf",
                         "macadam fit results/sweep/sweep.csv --curve --out results/law"});
  command.callback([arguments, &command] { fit_command(command, *arguments); });
}

}  // namespace macadam
