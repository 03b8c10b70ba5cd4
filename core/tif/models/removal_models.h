#pragma once

#include <string>
#include <vector>

#include "core/base/spec_text.h"
#include "core/tif/models/removal_model.h"
#include "core/tif/removal_function.h"
#include "core/tif/removal_shape.h"

namespace dwell {

/// Every model, in the order of the documentation: a new one is its two files and its row.
const std::vector<RemovalModel>& removal_models();

/// Throws InputError listing the models.
const RemovalModel& removal_model(const std::string& name);
bool is_removal_model(const std::string& name);

/// Throws InputError naming the model, the parameter, its value and what is accepted.
void check_model_parameter(const RemovalModel& model, const ModelParameter& parameter, double value);

/// The removal function of a specification such as "planetary:radius=5,eccentricity=0.8,ratio=-1,peak=20": the model's
/// own keys, and `peak` [nm/s] or, for models of Preston's law, `preston` [1/Pa], `pressure` [Pa] and `rpm`
/// (rate = preston * pressure * 2 pi rpm / 60 * shape). gaussian and disc keep their closed forms; every other model is
/// sampled, see sampled_removal. Throws InputError.
RemovalFunction removal_of_spec(const SpecText& spec);

/// The shape times `scale`, sampled about the tool axis to its reach: of 97, 193, 385 or 769 samples across, the fewest
/// whose spline differs from the formula between the samples by at most 1e-3 of the formula's RMS, else the most. Pitch
/// and difference are in the history. Cost: at most 1.2 million evaluations of the shape.
RemovalFunction sampled_removal(const RemovalShape& shape, double scale, const std::string& model);

/// Samples of any removal function on its own fine grid [nm/s], origin relative to the tool axis: those it has, or of
/// its closed form 257 x 257 to its radius, a disc's as means over each sample's cell.
HeightMap removal_samples(const RemovalFunction& tif);

}  // namespace dwell
