// Deforms vertices from the geometry pool: morph targets, then skinning. The skinning pass, the vertex
// shaders and the resolve share this code, so they get the same bits. glTF 2.0, 3.7.2.2 (morph targets),
// 3.7.3.3 (skins).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided

// Rows of a 3x4 matrix.
struct BlendedJoints
{
    vec4 x;
    vec4 y;
    vec4 z;
};

// Joint or weight i of a vertex. first: address of the first word of its joints or weights.
uint vertexInfluence(uint first, uint i) { return unpackInfluence(poolWord(first + (i >> 1)), i); }

BlendedJoints blendedJoints(ClusterDraw draw, Pose pose, uint vertex)
{
    uint layout_bits = draw.vertex_layout;
    uint count = influencesPerVertex(layout_bits);
    if (count == 0u)
    {
        PaletteRow node = loadJoint(pose, 0u);
        return BlendedJoints(node.world_from_bind_x, node.world_from_bind_y, node.world_from_bind_z);
    }
    uint joints = vertex + influenceWord(layout_bits);
    uint weights = joints + (count >> 1);
    precise BlendedJoints blended = BlendedJoints(vec4(0.0), vec4(0.0), vec4(0.0));
    for (uint i = 0u; i < count; ++i)
    {
        uint code = vertexInfluence(weights, i);
        // the largest weights come first
        if (code == 0u)
            break;
        precise float weight = float(code) * (1.0 / 65535.0);
        uint row = pose.palette_row + vertexInfluence(joints, i) * kPaletteRows;
        blended.x += deformationFloats(row) * weight;
        blended.y += deformationFloats(row + 1u) * weight;
        blended.z += deformationFloats(row + 2u) * weight;
    }
    return blended;
}

// Sum of the deltas of the morph targets of a vertex.
struct MorphDelta
{
    vec3 position;
    vec3 normal;
};

// Sum up the targets of the cluster's morph section.
MorphDelta morphDelta(ClusterDraw draw, Pose pose, uint index)
{
    precise MorphDelta delta = MorphDelta(vec3(0.0), vec3(0.0));
    if ((draw.counts & kDrawMorphs) == 0u)
        return delta;
    uint section = indexAddress(draw) + indexWords(triangleCount(draw));
    uint count = poolWord(section);
    for (uint i = 0u; i < count; ++i)
    {
        precise float weight = uintBitsToFloat(deformationWord(pose.morph_word + poolWord(section + morphTargetWord(i))));
        if (weight == 0.0)
            continue;
        precise float step_weight = poolFloat(section + morphStepWord(i)) * weight;
        precise float normal_weight = weight * (1.0 / kMorphNormalSteps);
        uint word = section + morphDeltaWord(count, vertexCount(draw), i, index);
        uvec3 codes = uvec3(poolWord(word), poolWord(word + 1u), poolWord(word + 2u));
        delta.position += vec3(morphPosition(codes.x), morphPosition(codes.y), morphPosition(codes.z)) * step_weight;
        delta.normal += vec3(morphNormal(codes.x), morphNormal(codes.y), morphNormal(codes.z)) * normal_weight;
    }
    return delta;
}

vec3 cofactorRow(vec3 a, vec3 b)
{
    precise vec3 c = vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
    return c;
}

vec3 transformVector(BlendedJoints joints, vec3 v) { return vec3(dot3(joints.x.xyz, v), dot3(joints.y.xyz, v), dot3(joints.z.xyz, v)); }

// Deformed position in world axes, relative to the instance's origin. index: index of the vertex in its
// cluster.
vec3 posedPosition(ClusterDraw draw, Pose pose, uint index)
{
    uint vertex = vertexAddress(draw, index);
    precise vec3 bind = vertexPosition(draw, vertex) + morphDelta(draw, pose, index).position;
    BlendedJoints joints = blendedJoints(draw, pose, vertex);
    precise vec3 position = transformVector(joints, bind) + vec3(joints.x.w, joints.y.w, joints.z.w);
    return position;
}

// Deformed normal, unit, world axes; the vertex has a normal. Normals transform by the inverse transpose: the
// cofactor matrix times the sign of the determinant.
vec3 posedNormal(ClusterDraw draw, Pose pose, uint index)
{
    uint vertex = vertexAddress(draw, index);
    precise vec3 bind = vertexNormal(draw, vertex) + morphDelta(draw, pose, index).normal;
    BlendedJoints joints = blendedJoints(draw, pose, vertex);
    vec3 cofactor_x = cofactorRow(joints.y.xyz, joints.z.xyz);
    vec3 cofactor_y = cofactorRow(joints.z.xyz, joints.x.xyz);
    vec3 cofactor_z = cofactorRow(joints.x.xyz, joints.y.xyz);
    precise vec3 normal = vec3(dot3(cofactor_x, bind), dot3(cofactor_y, bind), dot3(cofactor_z, bind));
    if (dot3(joints.x.xyz, cofactor_x) < 0.0)
        normal = -normal;
    precise float size = sqrt(dot3(normal, normal));
    return size > 0.0 ? normal / size : vec3(0.0);
}

// Deformed tangent, world axes; the vertex has a tangent.
vec3 posedTangent(ClusterDraw draw, Pose pose, uint index)
{
    uint vertex = vertexAddress(draw, index);
    vec3 bind = vertexTangent(draw, vertex, vertexNormal(draw, vertex)).xyz;
    return transformVector(blendedJoints(draw, pose, vertex), bind);
}
