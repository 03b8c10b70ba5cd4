#pragma once

#include "core/tif/models/removal_model.h"
#include "core/tif/removal_shape.h"

namespace dwell {

/// exp(-ln 2 (u^2 + v^2)) with u = 2 x' / fwhm_x, v = 2 y' / fwhm_y, x' and y' turned by `angle` [deg]
/// counter-clockwise from the axes of the machine. Reach: 1.5 times the larger width, as that of a Gaussian. Widths
/// [mm] > 0.
RemovalShape elliptic_gaussian_shape(double fwhm_x, double fwhm_y, double angle);

/// exp(-ln 2 (2 r / fwhm)^order): order 2 is the Gaussian, higher ones have a flatter top and steeper flanks. Reach:
/// where the exponent is -9 ln 2, which is 1.5 FWHM for a Gaussian. fwhm [mm] > 0, order > 0.
RemovalShape super_gaussian_shape(double fwhm, double order);

/// The D of magnetorheological finishing, as an empirical product: along the ribbon a Gaussian of unequal halves (the
/// two-piece normal distribution, Fechner 1897; Wallis 2014, https://doi.org/10.1214/13-STS417), across it a Gaussian:
/// exp(-ln 2 ((u / l)^2 + (2 v / width)^2)), u along the ribbon's motion from the peak, l = `lead` for u < 0 and
/// `trail` for u > 0: the distances from the peak to half of it, up- and downstream [mm]. `angle` [deg]: direction in
/// which the ribbon runs. It is no hydrodynamic model. Lengths > 0.
RemovalShape mrf_shape(double lead, double trail, double width, double angle);

/// Their rows in removal_models(). A gaussian keeps its closed form.
RemovalModel gaussian_model();
RemovalModel elliptic_gaussian_model();
RemovalModel super_gaussian_model();
RemovalModel mrf_model();

}  // namespace dwell
