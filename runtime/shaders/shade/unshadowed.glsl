// Light without shadows, in place of shadow.glsl: every light reaches every point.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided

float lightVisibility(Light light, SurfacePoint surface) { return 1.0; }
