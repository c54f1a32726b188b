// Calls the material function of a material. "material_functions.glsl" is generated for the game: it includes
// the functions, and chooses the one of a number.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/shading.h"
#include "runtime/shaders/scene/to_eye.glsl"

layout(constant_id = kConstantMaterialFunction) const uint kMaterialFunction = 0u;

// Place at which a material function computes the values of its material.
struct MaterialPoint
{
    vec3 position;    // world, metres
    vec3 position_dx; // per pixel: derivatives for textures that are mapped by position
    vec3 position_dy;
    vec3 normal;    // of the vertices: unit, world axes, towards the visible side
    vec3 tangent;   // unit, world axes, along u of the normal map's UV set, or of the first set
    vec3 bitangent; // along v
    vec3 to_eye;    // unit, world axes
    vec3 color;     // of the vertices: linear
    SurfaceUv uv;   // first UV set
    uint instance;
    vec4 inputs; // of the frame: hearth_frame::material_inputs
    vec4 parameters[kMaterialParameters]; // of the material: its extra "hearth_parameters"
};

// Transform UV coordinates with their derivatives: uv * scale + offset.
SurfaceUv scaleUv(SurfaceUv at, vec2 scale, vec2 offset)
{
    return SurfaceUv(at.uv * scale + offset, at.dx * scale, at.dy * scale);
}

// Sample a texture of the material (base_color_texture, metallic_roughness_texture, normal_texture,
// occlusion_texture, emissive_texture) with the mip that the derivatives ask for; white if it has none.
vec4 sampleAt(sampler2D image, SurfaceUv at) { return textureGrad(image, at.uv, at.dx, at.dy); }

#include "material_functions.glsl"

void changeMaterial(inout MaterialValues values, SurfacePoint point, SurfaceUvs uvs)
{
    if (kMaterialFunction == 0u)
        return;
    MaterialPoint at;
    at.position = view.eye + point.position;
    at.position_dx = point.position_dx;
    at.position_dy = point.position_dy;
    at.normal = point.front ? point.normal : -point.normal;
    at.tangent = point.tangent;
    at.bitangent = point.bitangent;
    at.to_eye = normalizeOr(toEye(point.position), at.normal);
    at.color = point.color;
    at.uv = uvs.sets[0];
    at.instance = point.instance;
    at.inputs = view.material_inputs;
    at.parameters = material.parameters;
    callMaterialFunction(kMaterialFunction, values, at);
    // whatever a function returns, shading divides by nothing and takes no root of a negative number
    values.base_color = max(values.base_color, vec3(0.0));
    values.metallic = clamp(values.metallic, 0.0, 1.0);
    values.roughness = clampRoughness(values.roughness);
    values.normal = normalizeOr(values.normal, at.normal);
    values.occlusion = clamp(values.occlusion, 0.0, 1.0);
    values.emission = max(values.emission, vec3(0.0));
}
