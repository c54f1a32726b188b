// Surfaces for tests of proxies.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/source_mesh.h"
#include "cook/proxy/surface/surface.h"

#include <string>

namespace hearth::test
{

/// Box between two corners, closed, 12 triangles that face outwards.
proxy::Surface makeBox(Float3 low, Float3 high);

/// Torus about the z axis of `segments` x `segments` quads, closed, genus 1, outward.
proxy::Surface makeTorus(float radius, float thickness, uint32_t segments);

/// Return a mesh's triangles, welded by position.
proxy::Surface toSurface(const mesh::SourceMesh& mesh);

/// Append the triangles of another surface without joining them.
void append(proxy::Surface& surface, const proxy::Surface& other);

/// Turn a triangle over.
void turn(proxy::Surface& surface, size_t triangle);

/// Return the volume that a closed surface encloses, negative if it faces inwards.
double signedVolume(const proxy::Surface& surface);

/// Return what keeps a surface from being a manifold, as findManifoldDefect does.
std::string findDefect(const proxy::Surface& surface);

/// Count the edges with one triangle.
size_t countBoundaryEdges(const proxy::Surface& surface);

/// Return V - E + F.
int64_t eulerCharacteristic(const proxy::Surface& surface);

} // namespace hearth::test
