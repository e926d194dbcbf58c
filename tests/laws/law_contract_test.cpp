// SPDX-License-Identifier: GPL-3.0-or-later
// law_contract_test.cpp  Tests which members a law must have to be stepped, and to be used in the frequency domain.
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <variant>

#include "host/harmonic/law_stiffness.hpp"

namespace macadam {
namespace {

using laws::Elastic;
using laws::GeneralisedKelvin;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// A law without a stiffness in the frequency domain.
struct Unknown {
  static constexpr const char* name = "unknown";
  double alpha = 0;
  int units() const { return 0; }
  double instantaneous() const { return 1; }
  double shortest_time() const { return infinity; }
  template <class R>
  struct Step {
    static constexpr bool memoryless = true;
    template <class S>
    S value(S x) const {
      return x;
    }
    template <int L, class S, class Units>
    S advance(S f, S dx, Units&&) const {
      return f + dx;
    }
  };
  template <class R>
  Step<R> step(double) const {
    return {};
  }
};
struct UnknownAndNotLinear : Unknown {
  static constexpr const char* name = "unknown_and_not_linear";
  static constexpr bool linear = false;
};

TEST(FrequencyDomain, TakesLawsThatHaveAStiffnessAndNamesOthers) {
  using Any = std::variant<Elastic, Unknown, UnknownAndNotLinear>;
  const auto ask = [](const Any& law) {
    return with_stiffness<double>(PairType::ma, law, [](const auto& own) { return own.stiffness({0, 1}).real(); });
  };
  EXPECT_EQ(ask(Elastic{3e9}), 3e9);
  const auto message = [&](const Any& law) -> std::string {
    try {
      ask(law);
    } catch (const InputError& error) { return error.what(); }
    return "taken";
  };
  EXPECT_EQ(message(Unknown{}),
            "contacts of M-A: law: found unknown, which has no complex stiffness, expected a law with a complex "
            "stiffness, because solutions in the frequency domain need one; or method = \"explicit\" with kind = "
            "\"cyclic\", which steps any law");
  EXPECT_NE(message(UnknownAndNotLinear{})
                .find("unknown_and_not_linear, which has no complex stiffness because it is not linear"),
            std::string::npos);
  static_assert(!has_stiffness<Unknown> && has_stiffness<Elastic> && has_stiffness<GeneralisedKelvin>);
}

struct WithoutName : Unknown {
  static constexpr int name = 3;
};
struct WithoutTime : Unknown {
  double shortest_time = 1;
};
struct WithoutValue : Unknown {
  template <class R>
  struct Step {
    static constexpr bool memoryless = true;
    template <int L, class S, class Units>
    S advance(S f, S, Units&&) const {
      return f;
    }
  };
  template <class R>
  Step<R> step(double) const {
    return {};
  }
};
/// A law that declares itself coupled, but has neither advance_point() nor the number of its units.
struct Coupled : UnknownAndNotLinear {
  template <class R>
  struct Step {
    static constexpr bool memoryless = false, coupled = true;
  };
  template <class R>
  Step<R> step(double) const {
    return {};
  }
};

// The concept SteppableLaw lists what a stepper requires of a law. A type that lacks one requirement does not satisfy
// the concept.
TEST(Contract, IsAConcept) {
  using laws::SteppableLaw;
  static_assert(SteppableLaw<Elastic> && SteppableLaw<GeneralisedKelvin> && SteppableLaw<Unknown>);
  static_assert(SteppableLaw<UnknownAndNotLinear>);
  static_assert(!SteppableLaw<WithoutName> && !SteppableLaw<WithoutTime> && !SteppableLaw<WithoutValue>);
  static_assert(!SteppableLaw<Coupled> && !SteppableLaw<double>);
}

}  // namespace
}  // namespace macadam
