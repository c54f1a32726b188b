// Daylight of a clear sky: sun and sky by the height of the sun and the haze of the air (C++ only).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "formats/gpu_shared/language.h"

namespace hearth::shared
{

/// Time of day and state of the air.
struct Daylight
{
    float elevation_deg = 45; ///< of the sun above the horizon, [0, 90]
    float azimuth_deg = 0;    ///< of the sun: 0 towards -z, 90 towards +x
    float turbidity = 3;      ///< haze, [2.5, 8]: 3 clear, 6 hazy; beyond them skies turn green, or brown

    bool operator==(const Daylight&) const = default;
};

/// Sun and sky of a daylight, after exposure: a sun of 45 degrees in clear air (turbidity 3) is as bright as
/// the sun of scenes without lights.
struct DaylightColors
{
    Float3 sun_direction;   ///< of its rays, unit
    Float3 sun_illuminance; ///< of a surface that faces the sun
    Float3 zenith;          ///< radiance of the gradient (shared::Sky)
    Float3 horizon;
    Float3 ground; ///< that reflects a fifth of sun and sky
};

/// Return an error unless all is in its range. errors: usage.
Status checkDaylight(const Daylight& daylight);

/// Return the sun and the gradient of a checked daylight. The gradient is the closest one to the model,
/// averaged around the vertical axis, and gives level ground the same irradiance. It takes about 0.4 ms.
/// source  Preetham, Shirley, Smits, "A Practical Analytic Model for Daylight", SIGGRAPH 1999: section 3 and
///         appendix 1 the sun, appendix 2 the sky
DaylightColors makeDaylight(const Daylight& daylight);

} // namespace hearth::shared
