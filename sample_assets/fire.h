// Generates a campfire around the origin: logs, embers and flames. Scenes place the ring of stones.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/document.h"

namespace hearth::samples
{

/// Make a log of unit length along +Y from the origin, radius `radius`; UV u around, v along.
TriangleMesh makeLog(float radius, uint32_t seed);

/// Add a log material: fresh bark all over (`burning` false), or charred with glowing cracks towards v = 0,
/// the burning end.
int addLogMaterial(Document& document, bool burning);

/// Make a shallow mound of coals, 0.5 m in radius.
TriangleMesh makeEmberBed();
int addEmberMaterial(Document& document);

/// Add the glowing bed of the fire, and a root node for it.
void addEmbers(Document& document);
/// Add the logs that burn on it.
void addBurningLogs(Document& document);

/// Make crossed flame cards around +Y, about 0.8 m high.
TriangleMesh makeFlames();
int addFlameMaterial(Document& document);

} // namespace hearth::samples
