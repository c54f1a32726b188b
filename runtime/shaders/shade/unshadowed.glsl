// Light without shadows, in place of shadow.glsl: every light reaches every point.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided

float lightVisibility(Light light, vec3 position, vec3 flat_normal, float error) { return 1.0; }
