// SPDX-License-Identifier: MIT
// Uses Embree 3 to draw the picture that clrt draws, for the comparison in tools/bench. Prints the
// measurements as JSON.
#include "base/clock.h"
#include "image/pfm.h"
#include "peer_draw.h"

#include <errno.h>
#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    const char *scene, *modes, *picture;
    uint32_t frames;
    bool tunes;
    enum RTCIntersectContextFlags flags[RAY_KINDS];
    PeerSettings settings;
} Options;

static const char kind_letters[RAY_KINDS] = {'c', 's', 'r'};
static const char *const quality_names[] = {"low", "medium", "high"};

static void usage(void)
{
    fprintf(stderr,
            "Usage: embree_peer SCENE [-m MODE,...] [-f FRAMES] [-j THREADS] [-s WxH]\n"
            "    [-q low|medium|high] [-r] [-c KINDS] [-o PICTURE.pfm]\n"
            "MODE is single, packet4, packet8, packet16 or stream (default: all). -r selects "
            "Embree's robust mode.\n"
            "KINDS are the coherent rays: c (camera), s (shadow) and r (reflected), as in cs, or\n"
            "best (default) for the fastest choice. PICTURE comes from the last of these modes.\n");
    exit(2);
}

static bool read_quality(const char *name, enum RTCBuildQuality *quality)
{
    for (int i = 0; i < 3; i++)
        if (strcmp(name, quality_names[i]) == 0) {
            *quality = (enum RTCBuildQuality)i;
            return true;
        }
    return false;
}

static void set_coherent(Options *options, const char *kinds)
{
    options->tunes = strcmp(kinds, "best") == 0;
    for (int kind = 0; kind < RAY_KINDS; kind++)
        options->flags[kind] = strchr(kinds, kind_letters[kind]) != NULL
                                   ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                   : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
}

static Options read_options(int count, char **words)
{
    Options options = {.modes = "single,packet4,packet8,packet16,stream",
                       .frames = 5,
                       .settings = {.quality = RTC_BUILD_QUALITY_MEDIUM, .threads = 1}};
    bool ok = true;
    set_coherent(&options, "best");
    for (int option; (option = getopt(count, words, "m:f:j:s:q:rc:o:")) != -1;)
        switch (option) {
        case 'm':
            options.modes = optarg;
            break;
        case 'f':
            ok = ok && sscanf(optarg, "%u", &options.frames) == 1;
            break;
        case 'j':
            ok = ok && sscanf(optarg, "%u", &options.settings.threads) == 1;
            break;
        case 's':
            ok = ok &&
                 sscanf(optarg, "%ux%u", &options.settings.width, &options.settings.height) == 2;
            break;
        case 'q':
            ok = ok && read_quality(optarg, &options.settings.quality);
            break;
        case 'r':
            options.settings.robust = true;
            break;
        case 'c':
            set_coherent(&options, optarg);
            break;
        case 'o':
            options.picture = optarg;
            break;
        default:
            ok = false;
        }
    if (!ok || optind + 1 != count)
        usage();
    options.scene = words[optind];
    return options;
}

static bool is_asked(const char *modes, const char *name)
{
    const size_t length = strlen(name);
    for (const char *at = modes; (at = strstr(at, name)) != NULL; at += length)
        if ((at == modes || at[-1] == ',') && (at[length] == ',' || at[length] == '\0'))
            return true;
    return false;
}

static double time_picture(const PeerPicture *picture, Framebuffer *framebuffer)
{
    const double start = clock_seconds();
    peer_draw(picture, framebuffer);
    return clock_seconds() - start;
}

// Finds for each kind of ray whether Embree's coherent flag is faster. The kinds are independent,
// so they are tested one after another. Returns the seconds with the flag set for all kinds.
static double tune(PeerPicture *picture, Framebuffer *framebuffer)
{
    for (int kind = 0; kind < RAY_KINDS; kind++)
        picture->flags[kind] = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    const double coherent = time_picture(picture, framebuffer);
    double best = coherent;
    for (int kind = 0; kind < RAY_KINDS; kind++) {
        picture->flags[kind] = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
        const double seconds = time_picture(picture, framebuffer);
        if (seconds > best)
            picture->flags[kind] = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        best = fmin(best, seconds);
    }
    return coherent;
}

// Draws a picture to warm up, then the measured pictures, and prints the results.
static void measure(PeerPicture *picture, const Options *options, Framebuffer *framebuffer)
{
    const PeerCounts counts = peer_draw(picture, framebuffer);
    printf("    \"%s\": {\n      \"rays\": {\"camera\": %llu, \"shadow\": %llu, "
           "\"reflected\": %llu},\n",
           picture->mode->name, (unsigned long long)counts.rays[RAY_CAMERA],
           (unsigned long long)counts.rays[RAY_SHADOW],
           (unsigned long long)counts.rays[RAY_REFLECTED]);
    if (options->tunes)
        printf("      \"all_coherent_seconds\": %.6f,\n", tune(picture, framebuffer));
    printf("      \"coherent\": \"");
    for (int kind = 0; kind < RAY_KINDS; kind++)
        if (picture->flags[kind] == RTC_INTERSECT_CONTEXT_FLAG_COHERENT)
            putchar(kind_letters[kind]);
    printf("\",\n      \"frame_seconds\": [");
    for (uint32_t frame = 0; frame < options->frames; frame++)
        printf("%s%.6f", frame == 0 ? "" : ", ", time_picture(picture, framebuffer));
    printf("]}");
}

static void measure_modes(const Options *options, const PeerScene *scene, Framebuffer *framebuffer)
{
    const char *separator = "";
    printf("{\n  \"triangles\": %u, \"threads\": %u, \"quality\": \"%s\", \"robust\": %s,\n"
           "  \"width\": %u, \"height\": %u, \"build_seconds\": %.6f,\n  \"modes\": {\n",
           scene->triangle_count, options->settings.threads,
           quality_names[options->settings.quality], options->settings.robust ? "true" : "false",
           scene->width, scene->height, scene->build_seconds);
    for (int i = 0; i < peer_mode_count; i++) {
        PeerPicture picture = {
            .scene = scene, .mode = &peer_modes[i], .threads = options->settings.threads};
        if (!is_asked(options->modes, peer_modes[i].name))
            continue;
        memcpy(picture.flags, options->flags, sizeof picture.flags);
        fputs(separator, stdout);
        measure(&picture, options, framebuffer);
        separator = ",\n";
    }
    printf("\n  }\n}\n");
}

static bool write_picture(const Framebuffer *framebuffer, const char *path, Error *error)
{
    FILE *stream = fopen(path, "wb");
    bool ok = stream != NULL && pfm_write(framebuffer, stream);
    if (stream != NULL)
        ok = fclose(stream) == 0 && ok;
    return ok || error_set(error, "%s: cannot be written: %s", path, strerror(errno));
}

int main(int count, char **words)
{
    const Options options = read_options(count, words);
    Error error = {0};
    PeerScene scene;
    Framebuffer framebuffer = {0};
    bool ok = peer_scene_open(&scene, options.scene, &options.settings, &error) &&
              framebuffer_make(&framebuffer, scene.width, scene.height, &error);
    if (ok) {
        measure_modes(&options, &scene, &framebuffer);
        ok = options.picture == NULL || write_picture(&framebuffer, options.picture, &error);
    }
    framebuffer_free(&framebuffer);
    peer_scene_close(&scene);
    if (!ok)
        fprintf(stderr, "embree_peer: %s\n", error.text);
    return ok ? 0 : 1;
}
