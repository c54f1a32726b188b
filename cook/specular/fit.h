// Finds the constants of the fit in formats/gpu_shared/specular_occlusion.h.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/specular/configurations.h"

#include <string>

namespace hearth::specular
{

struct ConstantsFit
{
    shared::SpecularFit constants;
    int iterations = 0;
    double start_rms = 0; ///< with the constants in the header
    double rms = 0;
};

/// Fit the constants to exact values of random configurations by least squares, starting from the constants
/// in the header. Ceres runs on one thread: the same constants for the same seed.
ConstantsFit fitConstants(size_t configuration_count, uint64_t seed, Masking masking);

/// Format the constants as in the header.
std::string formatConstants(const shared::SpecularFit& fit);

} // namespace hearth::specular
