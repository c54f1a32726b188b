// Shadow maps of the frame. Needs formats/gpu_shared/shadow.h.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided

layout(set = 0, binding = 9, std140) uniform Shadows { ShadowBlock shadows; };
