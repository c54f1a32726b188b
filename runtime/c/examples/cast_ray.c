/* cast_ray PACK.hearth NAME: finds an instance by the name of its node, and prints what is hit by a ray that falls
 * through the middle of its bounds. Needs no graphics device.
 * SPDX-License-Identifier: LicenseRef-Hearth-Undecided */
#include <hearth.h>
#include <stdio.h>
#include <stdlib.h>

static char why[512];

/* Exit if a call failed. */
static void check(hearth_result result)
{
    if (result == HEARTH_OK)
        return;
    fprintf(stderr, "cast_ray: %s\n", why[0] == '\0' ? hearth_result_string(result) : why);
    exit(1);
}

static void print_name(const char* what, const hearth_pack* pack, uint32_t table, uint32_t index)
{
    hearth_name name;
    check(hearth_pack_get_name(pack, table, index, &name, why, sizeof(why)));
    printf("%s %.*s\n", what, (int)name.length, name.text);
}

static void cast(hearth_pack* pack, hearth_queries* queries, uint32_t instance)
{
    hearth_box box;
    hearth_ray ray = {{0, 0, 0}, {0, -1, 0}, 0, 0};
    hearth_hit hit;
    check(hearth_queries_get_bounds(queries, instance, 1, &box, why, sizeof(why)));
    ray.origin[0] = 0.5f * (box.min[0] + box.max[0]);
    ray.origin[1] = box.max[1] + 1;
    ray.origin[2] = 0.5f * (box.min[2] + box.max[2]);
    ray.t_max = box.max[1] - box.min[1] + 2;
    check(hearth_queries_cast_rays(queries, &ray, 1, NULL, &hit, why, sizeof(why)));
    if (hit.instance == UINT32_MAX)
    {
        printf("nothing\n");
        return;
    }
    print_name("node", pack, HEARTH_TABLE_NODES, hit.node);
    if (hit.material != UINT32_MAX)
        print_name("material", pack, HEARTH_TABLE_MATERIALS, hit.material);
    printf("position %g %g %g\n", hit.position[0], hit.position[1], hit.position[2]);
}

int main(int argc, char** argv)
{
    const hearth_queries_options options = HEARTH_QUERIES_OPTIONS_INIT;
    hearth_pack* pack = NULL;
    hearth_queries* queries = NULL;
    uint32_t instance = 0;
    if (argc != 3)
    {
        fprintf(stderr, "usage: cast_ray PACK.hearth NAME\n");
        return 1;
    }
    check(hearth_pack_open(argv[1], &pack, why, sizeof(why)));
    check(hearth_pack_find_record(pack, HEARTH_TABLE_INSTANCES, argv[2], 0, &instance, why, sizeof(why)));
    check(hearth_queries_create(pack, &options, &queries, why, sizeof(why)));
    cast(pack, queries, instance);
    hearth_queries_destroy(queries);
    check(hearth_pack_close(pack));
    return 0;
}
