// Moves all vertices alike: by the first parameter, times an input.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
vec3 shift(MotionPoint point) { return point.parameters[0].xyz * (1.0 + point.inputs.w); }
