// Bends vertices by their place in the world, as wind does.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
vec3 sway(MotionPoint point)
{
    vec3 wave = sin(point.world.yzx * 3.0 + point.inputs.x);
    return wave * point.parameters[0].x * max(point.position.y + 1.0, 0.0);
}
