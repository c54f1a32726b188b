// Looks up the table of reflection on the CPU as shaders do on the GPU (C++ only).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/reflectance.h"
#include "formats/scene/reflectance_table.h"

namespace hearth::shared
{

static_assert(kReflectanceTable.size() == kReflectanceColumns * kReflectanceRows);

/// Interpolate between four nodes of the table.
/// roughness  perceptual
/// n_dot_v    cosine between normal and view, [0, 1]
LobeTotal lobeTotal(float roughness, float n_dot_v);

} // namespace hearth::shared
