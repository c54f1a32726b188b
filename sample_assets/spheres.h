// Generates spheres of five roughnesses, dielectric and metal, on a plinth under the sky and the default sun.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/document.h"

namespace hearth::samples
{

/// Make the scene; its camera is called `spheres`.
Document makeSpheres();

} // namespace hearth::samples
