#pragma once

#include "runs/campaigns/path_comparison.h"

namespace dwell {

/// The fields of a compared path that a part holds (runs/base/exact_json.h): all but its name, which follows from the
/// list, and the front, which only all paths show.

template <class Visit>
void each_field(PathMetrics& m, const Visit& visit) {
  visit("points", m.points), visit("length", m.length), visit("point_length", m.point_length);
  visit("lifted_length", m.lifted_length), visit("longest_jump", m.longest_jump), visit("lifts", m.lifts);
  visit("reversals", m.reversals), visit("sharpest_corner", m.sharpest_corner), visit("directions", m.directions);
  visit("anisotropy", m.anisotropy), visit("lattice_anisotropy", m.lattice_anisotropy);
}

template <class Visit>
void each_field(PathSpacing& s, const Visit& visit) {
  visit("points", s.points), visit("alone", s.alone), visit("min", s.min), visit("mean", s.mean);
  visit("deviation", s.deviation), visit("max", s.max);
}

template <class Visit>
void each_field(RippleBand& band, const Visit& visit) {
  visit("shortest", band.shortest), visit("longest", band.longest);
}

template <class Visit>
void each_field(RipplePeak& peak, const Visit& visit) {
  visit("wavelength", peak.wavelength), visit("direction_deg", peak.direction_deg), visit("rms", peak.rms);
  visit("share", peak.share);
}

template <class Visit>
void each_field(RippleSpectrum& s, const Visit& visit) {
  visit("band", s.band), visit("resolved", s.resolved), visit("rms", s.rms), visit("anisotropy", s.anisotropy);
  visit("peaks", s.peaks);
}

/// Without the map, which a comparison leaves empty.
template <class Visit>
void each_field(PathRipple& r, const Visit& visit) {
  visit("feed", r.feed), visit("spacing", r.spacing), visit("pve", r.pve), visit("pvn", r.pvn), visit("rms", r.rms);
  visit("spectrum", r.spectrum);
}

template <class Visit>
void each_field(PsdCurve& c, const Visit& visit) {
  visit("name", c.name), visit("unit", c.unit), visit("frequency", c.frequency), visit("density", c.density);
  visit("resolved_from", c.resolved_from), visit("resolved_to", c.resolved_to);
}

template <class Visit>
void each_field(SolverSummary& s, const Visit& visit) {
  visit("kind", s.kind), visit("status", s.status), visit("iterations", s.iterations);
  visit("operator_applications", s.operator_applications), visit("coarse_pairs", s.coarse_pairs);
  visit("wall_s", s.seconds), visit("objective", s.objective), visit("message", s.message);
}

template <class Visit>
void each_field(MapStatistics& s, const Visit& visit) {
  visit("valid_pixels", s.valid_pixels), visit("pv", s.pv), visit("rms", s.rms), visit("mean", s.mean);
  visit("pvr", s.pvr);
}

template <class Visit>
void each_field(ProgramFigures& p, const Visit& visit) {
  visit("file", p.file), visit("steps", p.steps), visit("removing_length", p.removing_length);
  visit("seconds", p.seconds), visit("rapid_seconds", p.rapid_seconds), visit("residual", p.residual);
  visit("standard_error", p.standard_error), visit("ripple", p.ripple), visit("ripple_error", p.ripple_error);
  visit("total", p.total), visit("checked", p.checked), visit("lattice_error", p.lattice_error);
  visit("removed", p.removed), visit("notes", p.notes);
}

template <class Visit>
void each_field(ComparedPath& p, const Visit& visit) {
  visit("failure", p.failure), visit("out_of_time", p.out_of_time), visit("kind", p.kind), visit("metrics", p.metrics);
  visit("spacing", p.spacing), visit("coverage", p.coverage), visit("tree_length", p.tree_length);
  visit("notes", p.notes), visit("limits", p.limits), visit("residual_rms", p.residual_rms);
  visit("residual_pv", p.residual_pv), visit("residual_pvr", p.residual_pvr);
  visit("residual_ripple", p.residual_ripple), visit("ripple", p.ripple), visit("no_ripple", p.no_ripple);
  visit("spectrum", p.spectrum), visit("dwell_total", p.dwell_total), visit("dwell_min", p.dwell_min);
  visit("dwell_max", p.dwell_max), visit("step_rms", p.step_rms), visit("lift_time", p.lift_time);
  visit("total_time", p.total_time), visit("solver", p.solver), visit("program", p.program);
}

}  // namespace dwell
