// Luminance that stands for specular light where one image has the sums of a pixel.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided

float specularLuminance(vec3 light) { return dot(light, vec3(0.2126, 0.7152, 0.0722)); }
