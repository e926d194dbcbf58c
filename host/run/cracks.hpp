// SPDX-License-Identifier: GPL-3.0-or-later
/// \file cracks.hpp  Counts the contact points that break during a stepped test, and finds whether the specimen is
/// still one piece.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "macadam/experiments/cracks.hpp"
#include "macadam/simulation.hpp"
#include "macadam/stepper.hpp"

namespace macadam {

/// The name of the table of events in the folder of the results.
inline constexpr const char* cracks_file = "cracks.csv";

/// Returns whether a run of this scene counts broken points: it is stepped, and one of its laws can break.
bool counts_cracks(const Scene& scene);

/// Reads the present state into `out`, whose memory is reused (Stepper::read_contacts()). The backend `reference` and
/// the method `quasi_static` only give `point_breaks` and `point_cracks`. All processes of a run must call this
/// together. \throws RunError as Stepper::contacts() does.
void read_contact_state(const Scene& scene, const Stepper& stepper, const ContactNetwork& network, ContactState& out);

/// Reads at each sample which contact points are broken. If no law of the scene can break, does nothing.
class CrackWatch {
 public:
  /// `before`: the events of a run that is resumed. Scene and preparation must outlive this object. \throws InputError
  /// for an event that does not belong to this specimen.
  CrackWatch(const Scene& scene, const Preparation& prepared, const std::vector<experiments::CrackEvent>& before = {});

  /// Returns whether the scene has contact points that can break, so that there is something to count.
  bool active() const { return active_; }
  /// Returns whether the scene has laws with a crack, so that look() also sums damage and energies.
  bool sums() const { return found_.sums.has_value(); }
  /// Adds an event for each point that has broken since the last call. Returns the events of this call. `state`: the
  /// present state, from read_contact_state().
  std::vector<experiments::CrackEvent> look(const ContactState& state, double time);
  std::vector<experiments::CrackEvent> look(const experiments::CrackSurvey& survey, double time);
  /// Returns whether contacts with at least one intact point join the top wall to the bottom wall or to a wall at the
  /// sides. Returns true also if the walls were not joined when the test began. All processes of a run must call this
  /// together.
  bool joins_walls() const;

  const experiments::Cracks& found() const { return found_; }

 private:
  void add(const experiments::CrackEvent& event);
  /// Counts cracked points by pair, and sums their energies. The bits do not depend on the number of threads.
  void sum(const std::vector<laws::PointCrack>& cracks);

  const ContactNetwork& network_;
  FactsTable laws_;
  bool active_, joined_at_start_;
  std::vector<bool> broken_;  // whether each contact point is broken
  /// Two ends of a contact, as in Contact, and the number of its points that are intact.
  struct Link {
    std::int32_t a, b;
    std::uint32_t intact;
  };
  std::vector<Link> links_;  // of all contacts, apart from the network because each look() reads all of them
  experiments::Cracks found_;
};

/// Return the header line of cracks.csv, and the line of an event. The columns x, y, z are the point's position in the
/// undeformed specimen. `openings`: whether a law of the scene has a crack, so that its opening, slip and damage have
/// columns.
/// @{
std::string crack_head(bool openings);
std::string crack_line(const Preparation& prepared, const experiments::CrackEvent& event, bool openings);
/// @}

/// to_numbers() returns the events as four numbers each, for a checkpoint; to_cracks() makes events of such numbers.
/// \throws InputError for numbers that are not events.
/// @{
std::vector<double> to_numbers(const std::vector<experiments::CrackEvent>& events);
std::vector<experiments::CrackEvent> to_cracks(const std::vector<double>& numbers);
/// @}

/// Returns `cracks` of summary.json: counts, area [m²] and time of the first event [s] of each pair that can break.
nlohmann::ordered_json cracks_json(const experiments::Cracks& cracks);

/// Returns `rupture` of summary.json: when and why a test ended early.
nlohmann::ordered_json rupture_json(const experiments::Rupture& rupture);

/// Returns the sentence that says when and why a test ended early.
std::string rupture_words(const experiments::Rupture& rupture);

/// Returns one line of text with the number of broken points, to be printed.
std::string cracks_words(const experiments::Cracks& cracks);

}  // namespace macadam
