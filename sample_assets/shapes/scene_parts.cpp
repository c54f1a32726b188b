// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/shapes/scene_parts.h"

#include "sample_assets/shapes/sample_math.h"

namespace hearth::samples
{

int addPlainMaterial(Document& document, const char* name, Float3 color, float roughness, float metallic)
{
    Material material;
    material.name = name;
    material.base_color = {color.x, color.y, color.z, 1};
    material.roughness = roughness;
    material.metallic = metallic;
    return add(document.materials, material);
}

int addEmissiveMaterial(Document& document, const char* name, Float3 color, float strength)
{
    const int index = addPlainMaterial(document, name, {0.8f, 0.8f, 0.8f}, 0.6f);
    document.materials[static_cast<size_t>(index)].emissive = color;
    document.materials[static_cast<size_t>(index)].emissive_strength = strength;
    return index;
}

void addObject(Document& document, const char* name, std::vector<Primitive> primitives)
{
    Node node;
    node.name = name;
    node.mesh = add(document.meshes, Mesh{name, std::move(primitives)});
    addRoot(document, node);
}

int addMesh(Document& document, const char* name, TriangleMesh mesh, int material)
{
    return add(document.meshes, Mesh{name, {{std::move(mesh), material}}});
}

void addPlaced(Document& document, const char* name, int mesh, const Placement& placement)
{
    Node node;
    node.name = name;
    node.mesh = mesh;
    node.placement = placement;
    addRoot(document, node);
}

void addCopies(Document& document, const char* name, int mesh, std::vector<Placement> placements)
{
    if (placements.empty())
        return;
    Node node;
    node.name = name;
    node.mesh = mesh;
    node.instances = std::move(placements);
    addRoot(document, node);
}

void addLight(Document& document, Light light, Float3 position, Float4 rotation)
{
    Node node;
    node.name = light.name;
    node.light = add(document.lights, std::move(light));
    node.placement = {position, rotation, {1, 1, 1}};
    addRoot(document, node);
}

void addCamera(Document& document, Camera camera, Float3 eye, Float3 target)
{
    Node node;
    node.name = camera.name;
    node.camera = add(document.cameras, std::move(camera));
    node.placement = {eye, rotationLookingAt(eye, target), {1, 1, 1}};
    addRoot(document, node);
}

} // namespace hearth::samples
