// Adds the common parts of furnished scenes to a document: plain materials, objects, lights and cameras.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/document.h"

namespace hearth::samples
{

/// Add a material without textures and return its index.
/// color  linear base colour
int addPlainMaterial(Document& document, const char* name, Float3 color, float roughness = 1,
                     float metallic = 0);

/// Add a grey material that shines and return its index.
/// color     0 to 1
/// strength  factor of `color`
int addEmissiveMaterial(Document& document, const char* name, Float3 color, float strength);

/// Add a mesh, and a root node for it.
void addObject(Document& document, const char* name, std::vector<Primitive> primitives);

/// Add a mesh of one primitive and return its index.
int addMesh(Document& document, const char* name, TriangleMesh mesh, int material);

/// Add a root node that draws the mesh at a placement.
void addPlaced(Document& document, const char* name, int mesh, const Placement& placement);

/// Add a root node that draws a copy of the mesh at each placement; none if there are no placements.
void addCopies(Document& document, const char* name, int mesh, std::vector<Placement> placements);

/// Add a light, and a root node for it, of the light's name.
/// rotation  unit quaternion; the light shines along its -Z axis
void addLight(Document& document, Light light, Float3 position, Float4 rotation);

/// Add a camera, and a root node for it, of the camera's name.
void addCamera(Document& document, Camera camera, Float3 eye, Float3 target);

} // namespace hearth::samples
