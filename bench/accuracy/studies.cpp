// SPDX-License-Identifier: GPL-3.0-or-later
// studies.cpp  Makes the list of runs. Most runs differ from a base case (see Case) in one setting, some in several.
#include <algorithm>

#include "bench/accuracy/runner.hpp"

namespace macadam::accuracy {
namespace {

constexpr std::initializer_list<Precision> precisions{Precision::double_, Precision::mixed, Precision::single};
constexpr std::initializer_list<ContactForm> forms{ContactForm::condensed, ContactForm::points};
constexpr std::initializer_list<Geometry> geometries{Geometry::fixed, Geometry::updated};

/// Builds the list of runs.
class List {
 public:
  List(bool quick, bool full, bool cuda) : quick_(quick), full_(full), cuda_(cuda) {}

  std::vector<Case> make() {
    front();
    drift();
    rest();
    step_share();
    damping();
    strain();
    quadrature_and_filters();
    backends();
    tolerance();
    clusters_and_am2();
    return std::move(list_);
  }

 private:
  Case& add(const char* study, const char* scene, double frequency, double scaling) {
    Case& c = list_.emplace_back();
    c.study = study, c.scene = scene, c.frequency = frequency, c.density_scaling = scaling;
    return c;
  }

  /// Adds runs that compare error and run time from the steady start, for combinations of contact form, precision,
  /// geometry and density scaling.
  void front() {
    for (const double scaling : quick_ ? std::vector{1e4, 1e3} : std::vector{1e4, 1e3, 1e2, 1e1}) {
      for (const ContactForm form : forms) {
        for (const Precision precision : precisions) {
          for (const Geometry geometry : geometries) {
            if (scaling < 1e2 && form == ContactForm::points) continue;
            Case& c = add("front", "t8", 20, scaling);
            c.form = form, c.precision = precision, c.geometry = geometry;
          }
        }
      }
    }
    if (quick_) {
      add("front", "demo", 20, 1e4);
      return;
    }
    for (const double scaling : {1e4, 1e3, 1e2, 1e1}) add("front", "t8", 2, 100 * scaling);
    for (const double scaling : {1e5, 1e4, 1e3}) {
      for (const Precision precision : precisions) {
        for (const Geometry geometry : geometries) {
          if (scaling < 1e4 && (precision == Precision::double_ || geometry == Geometry::updated)) continue;
          Case& c = add("front", "demo", 20, scaling);
          c.precision = precision, c.geometry = geometry;
        }
      }
      if (scaling > 1e3) add("front", "demo", 20, scaling).form = ContactForm::points;
      add("front", "demo", 2, 100 * scaling);
    }
    add("front", "demo", 20, 1e2);
    if (!full_) return;
    for (const double scaling : {1e5, 1e4, 1e3}) add("front", "full", 20, scaling);
    add("front", "full", 2, 1e6);
  }

  /// Adds runs that show how the rounding error grows with the number of steps. Lower density scalings have more steps;
  /// a scaling of 1 is true mass. bench/accuracy/draw.py draws the differences from double precision at the same
  /// settings.
  void drift() {
    for (const double frequency : {20.0, 2.0}) {
      std::vector<double> scalings{1e4, 1e3, 1e2};
      if (!quick_) scalings.insert(scalings.end(), {1e1, 1e0});
      for (const double scaling : scalings) {
        if (quick_ && frequency == 2 && scaling < 1e3) continue;
        for (const Precision precision : precisions) {
          // these runs take minutes and add little
          if (frequency == 2 && scaling == 10 && precision == Precision::double_) continue;
          add("drift", "t8", frequency, scaling).precision = precision;
        }
      }
    }
    if (quick_) return;
    for (const double frequency : {20.0, 2.0}) {
      for (const Precision precision : precisions) {
        Case& c = add("drift", "t8", frequency, 1);
        c.precision = precision, c.geometry = Geometry::updated;
      }
    }
    for (const Precision precision : precisions) {  // many cycles of large steps
      Case& c = add("drift", "t8", 20, 1e3);
      c.precision = precision, c.cycles = {1, 2, 4, 8, 16};
    }
  }

  /// Adds runs from rest over many cycles. They show after how many cycles the steady state is reached, by comparison
  /// with the frequency-domain solution of the same inertia. The density scalings are about those that tolerances of
  /// 1e-2, 1e-3 and 1e-4 choose.
  void rest() {
    std::vector<int> cycles;
    for (int n = 1; n <= (quick_ ? 8 : 40); n += n < 16 ? 1 : 4) cycles.push_back(n);
    for (const double frequency : {20.0, 2.0}) {
      const double heavier = frequency == 2 ? 100 : 1;
      for (const double scaling : {1e5, 1e4, 1e3}) {
        if (!quick_ || scaling == 1e4) rest("t8", frequency, heavier * scaling, cycles);
      }
      if (!quick_) rest("demo", frequency, heavier * 1e4, {1, 2, 3, 4, 5, 6, 7, 8, 10, 12});
    }
  }
  void rest(const char* scene, double frequency, double scaling, const std::vector<int>& cycles) {
    for (const double ramp : {0.0, 1.0}) {
      Case& c = add("rest", scene, frequency, scaling);
      c.start = Start::rest, c.ramp_cycles = ramp, c.cycles = cycles;
    }
    add("rest", scene, frequency, scaling);  // a steady start for comparison
  }

  /// Adds runs with different time steps, given as fractions of the computed critical step. The computed critical step
  /// is about 0.71 of the true limit.
  void step_share() {
    for (const double share : {0.3, 0.5, 0.7, 0.8, 0.95, 1.1, 1.2, 1.3, 1.35, 1.4, 1.45}) {
      if (quick_ && share != 0.5 && share != 0.95 && share != 1.3) continue;
      step_share("t8", 1e3, share, Start::steady);
      step_share("t8", 1e3, share, Start::rest);
      if (!quick_) step_share("demo", 1e5, share, Start::steady);
    }
  }
  void step_share(const char* scene, double scaling, double share, Start start) {
    Case& c = add("step_share", scene, 20, scaling);
    c.step_share = share, c.start = start, c.precision = Precision::double_;
    if (start == Start::rest) c.cycles = {5};
  }

  void damping() {
    const auto with = [&](Damping kind, double value, double scaling) {
      Case& c = add("damping", "t8", 20, scaling);
      c.damping_kind = kind, c.damping = value;
      // the other runs start from rest, because local damping has no frequency-domain solution
      if (kind == Damping::viscous) return;
      c.start = Start::rest, c.cycles = {5};
    };
    for (const double scaling : quick_ ? std::vector{1e4} : std::vector{1e4, 1e2}) {
      with(Damping::none, 0, scaling);
      for (const double chi : {0.05, 0.1, 0.3, 0.7}) with(Damping::local, chi, scaling);
      for (const double beta : {1.0, 10.0, 100.0, 1000.0}) with(Damping::viscous, beta, scaling);
    }
  }

  /// Adds runs with different strain amplitudes. At the largest amplitude both fixed geometry and the linear solution
  /// are inaccurate.
  void strain() {
    for (const char* scene : {"t8", "demo"}) {
      const bool demo = scene[0] == 'd';
      if (quick_ && demo) break;
      for (const double strain : {1e-6, 1e-5, 1e-4, 3e-4, 1e-3, 3e-3, 1e-2}) {
        if (quick_ && strain != 1e-4 && strain != 1e-2) continue;
        if (demo && strain != 1e-4 && strain != 1e-3 && strain != 1e-2) continue;
        for (const Geometry geometry : geometries) {
          Case& c = add("strain", scene, 20, demo ? 1e5 : 1e4);
          c.strain = strain, c.geometry = geometry, c.cycles = {1, 2, 4};
        }
      }
    }
  }

  void quadrature_and_filters() {
    for (const char* scene : {"t8", "demo"}) {
      const bool demo = scene[0] == 'd';
      if (quick_ && demo) break;
      for (const double frequency : {20.0, 2.0}) {
        const double scaling = (demo ? 1e5 : 1e4) * (frequency == 2 ? 100 : 1);
        for (const Quadrature quadrature : {Quadrature::lumped, Quadrature::exact}) {
          add("quadrature", scene, frequency, scaling).quadrature = quadrature;
        }
      }
      add("filter", scene, 20, demo ? 1e5 : 1e4);
      for (const double gap : {0.5, 0.2, 0.1, 0.05, 0.0}) add("filter", scene, 20, demo ? 1e5 : 1e4).gap_max = gap;
      for (const double area : {0.001, 0.01, 0.026, 0.1}) add("filter", scene, 20, demo ? 1e5 : 1e4).area_min = area;
    }
  }

  void backends() {
    for (const double scaling : {1e5, 1e4}) {
      for (const Backend backend : {Backend::cpu, Backend::reference}) {
        Case& c = add("backend", "t8", 20, scaling);
        c.backend = backend, c.precision = Precision::double_, c.form = ContactForm::points;
        c.geometry = Geometry::updated;
      }
    }
    if (!cuda_) return;
    for (const char* scene : {"t8", "demo", "full"}) {
      if (quick_ && scene[0] != 't') break;
      for (const double scaling : {1e4, 1e3, 1e2}) {
        for (const Precision precision : precisions) {
          if (scene[0] == 'f' && (!full_ || scaling < 1e3)) continue;
          Case& c = add("backend", scene, 20, scaling);
          c.backend = Backend::cuda, c.precision = precision;
        }
      }
    }
  }

  /// Adds runs in which `[solver] tolerance` chooses the settings.
  void tolerance() {
    for (const char* scene : {"t8", "seed 101", "seed 102", "demo"}) {
      if (quick_ && scene[0] != 't') break;
      for (const double frequency : {2.0, 5.0, 10.0, 20.0}) {
        for (const double asked : {1e-2, 1e-3, 1e-4}) {
          if (quick_ && asked < 1e-3) continue;
          add("tolerance", scene, frequency, 0).tolerance = asked;
        }
      }
    }
  }

  /// Repeats a selection of the studies above (error against time, drift, filters, tolerances) for clusters and for
  /// AM2; the studies above use single spheres and AM1.
  void clusters_and_am2() {
    const auto with_mix = [&](const char* mix, const char* study, const char* scene, double frequency,
                              double scaling) -> Case& {
      Case& c = add(study, scene, frequency, scaling);
      c.mix = mix;
      return c;
    };
    const auto clusters = [&](const char* study, double frequency, double scaling) -> Case& {
      return with_mix("AM1", study, "clusters", frequency, scaling);
    };
    const auto am2 = [&](const char* study, double frequency, double scaling) -> Case& {
      return with_mix("AM2", study, "seed 101", frequency, scaling);
    };
    clusters("front", 20, 1e5);
    am2("front", 20, 1e4);
    am2("tolerance", 20, 0).tolerance = 1e-2;
    if (quick_) return;

    clusters("front", 20, 1e4);
    clusters("front", 2, 1e6);
    clusters("front", 20, 1e4).form = ContactForm::points;
    clusters("front", 20, 1e4).geometry = Geometry::updated;
    with_mix("AM2", "front", "clusters", 20, 1e5);
    with_mix("AM2", "front", "clusters", 20, 1e4);
    for (const double scaling : {1e3, 1e2, 1e1}) {
      am2("front", 20, scaling);
      am2("front", 2, 100 * scaling);
    }
    for (const Precision precision : precisions) {
      for (const double scaling : {1e5, 1e4, 1e3}) clusters("drift", 20, scaling).precision = precision;
      for (const double scaling : {1e4, 1e2, 1e1}) am2("drift", 20, scaling).precision = precision;
    }
    clusters("filter", 20, 1e5), am2("filter", 20, 1e5);
    for (const double gap : {0.2, 0.05, 0.0}) {
      clusters("filter", 20, 1e5).gap_max = gap;
      am2("filter", 20, 1e5).gap_max = gap;
    }
    for (const double area : {0.001, 0.01, 0.026, 0.1}) {
      clusters("filter", 20, 1e5).area_min = area;
      am2("filter", 20, 1e5).area_min = area;
    }
    for (const double frequency : {2.0, 20.0}) {
      for (const double asked : {1e-2, 1e-3, 1e-4}) {
        if (asked > 1e-4) clusters("tolerance", frequency, 0).tolerance = asked;
        if (asked > 1e-3) with_mix("AM2", "tolerance", "clusters", frequency, 0).tolerance = asked;
        if (asked < 1e-2 || frequency == 2) am2("tolerance", frequency, 0).tolerance = asked;
      }
    }
  }

  bool quick_, full_, cuda_;
  std::vector<Case> list_;
};

}  // namespace

std::vector<Case> studies(bool quick, bool full, bool cuda) { return List(quick, full, cuda).make(); }

}  // namespace macadam::accuracy
