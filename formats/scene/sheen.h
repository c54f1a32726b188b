// Looks up the table of sheen on the CPU as shaders do on the GPU (C++ only).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/sheen.h"
#include "formats/scene/sheen_table.h"

namespace hearth::shared
{

static_assert(kSheenTable.size() == kReflectanceColumns * kReflectanceRows);

/// Interpolate between four nodes of the table.
/// roughness  perceptual
/// n_dot_v    cosine between normal and view, [0, 1]
SheenTotal sheenTotal(float roughness, float n_dot_v);

} // namespace hearth::shared
