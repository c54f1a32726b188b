// Types of values for which half precision suffices, such as colours, albedos and shares of light: mediump in
// GLSL, RelaxedPrecision in SPIR-V. C++ computes them in full. An expression of such values alone is relaxed,
// one with a full operand is full. Constructors are those of the full types.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_PRECISION_H
#define HEARTH_SHARED_PRECISION_H

#include "formats/gpu_shared/language.h"

// Halves have 11 bits, and end at 65504 and at 6e-5, below which a device may have 0. Full stay: positions,
// UVs, depths and whatever they decide; distributions of microfacets, whose peaks are above the end and whose
// cosines next to 1 matter; irradiances of lamps; quotients whose divisor may be below the end.

#ifdef __cplusplus
namespace hearth::shared
{
using Half = float;
using Half2 = Float2;
using Half3 = Float3;
using Half4 = Float4;
} // namespace hearth::shared
#else
// the default that Vulkan gives, which glslang wants said where anything is mediump
precision highp float;
precision highp int;

#define Half mediump float
#define Half2 mediump vec2
#define Half3 mediump vec3
#define Half4 mediump vec4
#endif

#endif
