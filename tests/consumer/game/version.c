/* The library is the one that the header belongs to: exit code 0.
 * SPDX-License-Identifier: LicenseRef-Hearth-Undecided */
#include <hearth.h>
#include <stdio.h>

int main(void)
{
    const uint32_t version = hearth_api_version();
    printf("%u.%u: %s\n", version >> 16, version & 0xFFFFu, hearth_result_string(HEARTH_OK));
    return version == HEARTH_API_VERSION ? 0 : 1;
}
