#pragma once

#include "runs/campaigns/path_comparison.h"
#include "runs/campaigns/solver_fields.h"

namespace dwell {

/// The fields of a compared path that a part holds (runs/base/exact_json.h): all but its name, which follows from the
/// list, and the front, which only all paths show.

template <class Visit>
void each_field(PathMetrics& m, const Visit& visit) {
  visit("points", m.points), visit("length_mm", m.length), visit("point_length_mm", m.point_length);
  visit("lifted_length_mm", m.lifted_length), visit("longest_jump_mm", m.longest_jump), visit("lifts", m.lifts);
  visit("reversals", m.reversals), visit("sharpest_corner_deg", m.sharpest_corner), visit("directions", m.directions);
  visit("anisotropy", m.anisotropy), visit("lattice_anisotropy", m.lattice_anisotropy);
}

template <class Visit>
void each_field(PathSpacing& s, const Visit& visit) {
  visit("points", s.points), visit("alone", s.alone), visit("min_mm", s.min), visit("mean_mm", s.mean);
  visit("deviation_mm", s.deviation), visit("max_mm", s.max);
}

template <class Visit>
void each_field(RippleBand& band, const Visit& visit) {
  visit("shortest_mm", band.shortest), visit("longest_mm", band.longest);
}

template <class Visit>
void each_field(RipplePeak& peak, const Visit& visit) {
  visit("wavelength_mm", peak.wavelength), visit("direction_deg", peak.direction_deg), visit("rms_nm", peak.rms);
  visit("share", peak.share);
}

template <class Visit>
void each_field(RippleSpectrum& s, const Visit& visit) {
  visit("band", s.band), visit("resolved", s.resolved), visit("rms_nm", s.rms), visit("anisotropy", s.anisotropy);
  visit("peaks", s.peaks);
}

/// Without the map, which a comparison leaves empty.
template <class Visit>
void each_field(PathRipple& r, const Visit& visit) {
  visit("feed_mm_per_s", r.feed), visit("spacing_mm", r.spacing), visit("pve_nm", r.pve), visit("pvn", r.pvn),
      visit("rms_nm", r.rms);
  visit("spectrum", r.spectrum);
}

template <class Visit>
void each_field(PsdCurve& c, const Visit& visit) {
  visit("name", c.name), visit("unit", c.unit), visit("frequency_per_mm", c.frequency), visit("density", c.density);
  visit("resolved_from_per_mm", c.resolved_from), visit("resolved_to_per_mm", c.resolved_to);
}

template <class Visit>
void each_field(MapStatistics& s, const Visit& visit) {
  visit("valid_pixels", s.valid_pixels), visit("pv_nm", s.pv), visit("rms_nm", s.rms), visit("mean_nm", s.mean);
  visit("pvr_nm", s.pvr);
}

template <class Visit>
void each_field(ProgramFigures& p, const Visit& visit) {
  visit("file", p.file), visit("steps", p.steps), visit("removing_length_mm", p.removing_length);
  visit("run_s", p.seconds), visit("rapid_s", p.rapid_seconds), visit("residual", p.residual);
  visit("standard_error_nm", p.standard_error), visit("ripple_nm", p.ripple), visit("ripple_error_nm", p.ripple_error);
  visit("total_nm", p.total), visit("checked", p.checked), visit("lattice_error_nm", p.lattice_error);
  visit("removed", p.removed), visit("notes", p.notes);
}

template <class Visit>
void each_field(ComparedPath& p, const Visit& visit) {
  visit("failure", p.failure), visit("out_of_time", p.out_of_time), visit("kind", p.kind), visit("metrics", p.metrics);
  visit("spacing", p.spacing), visit("coverage", p.coverage), visit("tree_length_mm", p.tree_length);
  visit("notes", p.notes), visit("limits", p.limits), visit("residual_rms_nm", p.residual_rms);
  visit("residual_pv_nm", p.residual_pv), visit("residual_pvr_nm", p.residual_pvr);
  visit("residual_ripple", p.residual_ripple), visit("ripple", p.ripple), visit("no_ripple", p.no_ripple);
  visit("spectrum", p.spectrum), visit("dwell_total_s", p.dwell_total), visit("dwell_min_s", p.dwell_min);
  visit("dwell_max_s", p.dwell_max), visit("step_rms_s", p.step_rms), visit("lift_time_s", p.lift_time);
  visit("total_time_s", p.total_time), visit("solver", p.solver), visit("program", p.program);
}

}  // namespace dwell
