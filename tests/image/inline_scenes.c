// SPDX-License-Identifier: MIT
// The scenes share one mesh: a wavy open sheet. Its normals have different lengths, and some are
// missing.
#include "image/inline_scenes.h"

#include "unit/cmocka_all.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#define SHEET_NAME "sheet.ply"
#define SIDE       10 // vertices along each side of the sheet

static char folder[] = "/tmp/clrt-scenes-XXXXXX";

static const struct {
    const char *name, *text;
} scenes_written[INLINE_COUNT] = {
    [INLINE_OPEN_SHEET] =
        {"open_sheet.scn",
         // The two-sided sheet from both sides and in a mirror, beside a one-sided copy, which is
         // invisible from below. Lights are above and below.
         "size 384 288\n"
         "background 0.2 0.4 0.7\n"
         "ambient 0.1\n"
         "max_level 6\n"
         "define gloss blinn_phong diffuse 0.3 0.6 0.2 specular 1 0.9 0.5 kd 0.7 ks 0.6 "
         "shininess 30.5\n"
         "define glass matte diffuse 0.9 0.8 0.7 kd 2.5 reflectivity 0.6\n"
         "light 1 -2 3 0.6\n"
         "light -1.5 0.5 -2 0.5\n"
         "light 0.1 0.2 0.45 0.2\n"
         "sides two\n"
         "material gloss\n"
         "mesh sheet.ply\n"
         "material glass\n"
         "mesh sheet.ply rotate 1 0 0 -90 translate 0 1.2 0.4\n"
         "sides one\n"
         "material 1\n"
         "mesh sheet.ply scale 0.8 rotate 0 1 0 20 translate 0.3 0 0.7\n"
         "material 2\n"
         "sphere 0.1 -0.3 0.5 0.15\n"
         "up 0.3 0.2 1\n"
         "camera 1.4 -2.6 1.3 0.1 0.2 0.3 50\n"
         "up 0 1 0\n"
         "camera -0.4 -0.5 -2.8 0 0.2 0.2 42\n"},
    [INLINE_MIRRORS] =
        {"mirrors.scn",
         // Flat normals, a mirror ball seen from outside and inside, sharp highlights, and an unlit
         // mirror.
         "size 320 320\n"
         "max_level 6\n"
         "normals flat\n"
         "define ball blinn_phong diffuse 0.1 0.2 0.5 ks 0.9 shininess 2000 reflectivity 0.6\n"
         "define facets blinn_phong diffuse 0.8 0.7 0.3 shininess 2000\n"
         "define pane silhouette diffuse 0.2 0.3 0.2 reflectivity 0.5\n"
         "light 2 -2 4 0.8 0.3 1 0.5\n"
         "light -3 -1 2 0.4 1 0 0.7\n"
         "material ball\n"
         "sphere 0 0 0.6 0.4\n"
         "material 2\n"
         "sphere -0.7 -0.2 0.3 0.2\n"
         "material facets\n"
         "mesh sheet.ply scale 2\n"
         "material pane\n"
         "mesh sheet.ply rotate 0 1 0 90 translate -1.1 0 0.6\n"
         "camera 2.2 -1.6 1.5 0 0 0.4 45\n"
         "camera 0.1 -0.1 0.7 -1 0.4 0.5 90\n"},
    [INLINE_FAR_AWAY] =
        {"far_away.scn",
         // A small scene on a ground sphere of radius 1e5, a thousand units from the origin.
         "size 300 200\n"
         "background 0.9 0.9 1\n"
         "define ground matte diffuse 0.6 0.6 0.5 reflectivity 0.6\n"
         "light 1003 -2004 3006 0.7\n"
         "light 1000.5 -2000.2 3000.6 0.4\n"
         "material ground\n"
         "sphere 1000 -2000 -97000.25 100000\n"
         "material 2\n"
         "sphere 1000.6 -2000.5 3000 0.25\n"
         "material 3\n"
         "mesh sheet.ply translate 1000 -2000 3000.2\n"
         "camera 1001.8 -2002.2 3001.2 1000 -2000 3000.1 40\n"},
    [INLINE_DISTANT_LIGHTS] = {"distant_lights.scn",
                               // Creases with shadows on themselves, above a floor a hundred times
                               // as wide. The lights are a thousand units away.
                               "size 384 288\n"
                               "background 0.3 0.4 0.5\n"
                               "light 600 -300 700 0.5 1 0.6 0.2\n"
                               "light -700 100 90 0.4 0.1 0.9 1\n"
                               "light 300 900 150 0.2\n"
                               "material 1\n"
                               "mesh sheet.ply scale 100 translate 0 0 -15.5\n"
                               "material 2\n"
                               "mesh sheet.ply scale 0.6 rotate 1 0 0 35\n"
                               "mesh sheet.ply scale 0.6 rotate 0 1 0 -75 translate 0.2 0.3 0.1\n"
                               "camera 2 -1.5 1 0 0 0 40\n"},
};

static void sheet_write(FILE *stream)
{
    fprintf(stream,
            "ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\nproperty float y\n"
            "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
            "element face %d\nproperty list uchar int vertex_indices\nend_header\n",
            SIDE * SIDE, 2 * (SIDE - 1) * (SIDE - 1));
    for (int vertex = 0; vertex < SIDE * SIDE; vertex++) {
        const double x = vertex % SIDE * (2.0 / (SIDE - 1)) - 1;
        const double y = vertex / SIDE * (2.0 / (SIDE - 1)) - 1;
        const double z = 0.15 * sin(4 * x) * cos(3 * y);
        const double length = vertex % 7 == 3 ? 0 : 1 + 0.3 * (vertex % 3);
        fprintf(stream, "%.7f %.7f %.7f %.6f %.6f %.6f\n", x, y, z,
                length * -0.6 * cos(4 * x) * cos(3 * y), length * 0.45 * sin(4 * x) * sin(3 * y),
                length);
    }
    for (int row = 0; row + 1 < SIDE; row++)
        for (int column = 0; column + 1 < SIDE; column++) {
            const int corner = row * SIDE + column;
            fprintf(stream, "3 %d %d %d\n3 %d %d %d\n", corner, corner + 1, corner + SIDE + 1,
                    corner, corner + SIDE + 1, corner + SIDE);
        }
}

static void make_path(const char *name, char path[INLINE_PATH_SIZE])
{
    snprintf(path, INLINE_PATH_SIZE, "%s/%s", folder, name);
}

void inline_scenes_path(InlineScene scene, char path[INLINE_PATH_SIZE])
{
    make_path(scenes_written[scene].name, path);
}

// Opens a file for writing, or returns NULL.
static FILE *open_file(const char *name)
{
    char path[INLINE_PATH_SIZE];
    make_path(name, path);
    return fopen(path, "w");
}

SET_UP(write_scenes)
{
    FILE *stream;
    if (mkdtemp(folder) == NULL || (stream = open_file(SHEET_NAME)) == NULL)
        return -1;
    sheet_write(stream);
    int failures = fclose(stream);
    for (int scene = 0; failures == 0 && scene < INLINE_COUNT; scene++) {
        if ((stream = open_file(scenes_written[scene].name)) == NULL)
            return -1;
        failures = fputs(scenes_written[scene].text, stream) < 0 || fclose(stream) != 0;
    }
    return failures;
}

TEAR_DOWN(remove_scenes)
{
    char path[INLINE_PATH_SIZE];
    make_path(SHEET_NAME, path);
    int failures = unlink(path);
    for (int scene = 0; scene < INLINE_COUNT; scene++) {
        inline_scenes_path((InlineScene)scene, path);
        failures |= unlink(path);
    }
    return failures | rmdir(folder);
}
