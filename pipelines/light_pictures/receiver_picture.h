// Draws the atlas of receivers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "pipelines/light_pictures/light_picture.h"

namespace hearth::light_pictures
{

/// Draw the irradiance of all lamps under full weights; texels of no surface are black.
/// shows_drops  texels with shared::kReceiverDrops are red
LightPicture drawReceivers(const formats::ReceiverTables& tables, bool shows_drops);

} // namespace hearth::light_pictures
