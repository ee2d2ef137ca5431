// SPDX-License-Identifier: MIT
// Threads take tile numbers from a common counter until all tiles are drawn. The calling thread
// also draws.
#include "peer_draw.h"

#include <pthread.h>
#include <stdatomic.h>
#ifdef __SSE__
#include <xmmintrin.h>
#endif

#define TILE_SIZE   32
#define THREADS_MAX 256

void draw_tile_single(PeerTile *tile);
void draw_tile_packet4(PeerTile *tile);
void draw_tile_packet8(PeerTile *tile);
void draw_tile_packet16(PeerTile *tile);
void draw_tile_stream(PeerTile *tile);

const PeerMode peer_modes[] = {{"single", draw_tile_single},
                               {"packet4", draw_tile_packet4},
                               {"packet8", draw_tile_packet8},
                               {"packet16", draw_tile_packet16},
                               {"stream", draw_tile_stream}};
const int peer_mode_count = sizeof peer_modes / sizeof peer_modes[0];

typedef struct {
    const PeerPicture *picture;
    Framebuffer *framebuffer;
    atomic_uint next_tile;
    atomic_ullong rays[RAY_KINDS];
} Work;

static uint32_t smaller(uint32_t a, uint32_t b)
{
    return a < b ? a : b;
}

// Embree's manual recommends both flags of x86 (FTZ, DAZ), because denormal numbers are slow.
static void flush_denormals(void)
{
#ifdef __SSE__
    _mm_setcsr(_mm_getcsr() | 0x8040);
#endif
}

static void *draw_tiles(void *argument)
{
    Work *work = argument;
    const PeerPicture *picture = work->picture;
    const uint32_t width = picture->scene->width, height = picture->scene->height;
    const uint32_t columns = (width + TILE_SIZE - 1) / TILE_SIZE;
    const uint32_t count = columns * ((height + TILE_SIZE - 1) / TILE_SIZE);
    PeerTile tile = {.scene = picture->scene, .framebuffer = work->framebuffer};
    for (int kind = 0; kind < RAY_KINDS; kind++)
        tile.flags[kind] = picture->flags[kind];
    flush_denormals();
    for (uint32_t i; (i = atomic_fetch_add(&work->next_tile, 1)) < count;) {
        tile.x = i % columns * TILE_SIZE;
        tile.y = i / columns * TILE_SIZE;
        tile.width = smaller(TILE_SIZE, width - tile.x);
        tile.height = smaller(TILE_SIZE, height - tile.y);
        picture->mode->draw_tile(&tile);
    }
    for (int kind = 0; kind < RAY_KINDS; kind++)
        atomic_fetch_add(&work->rays[kind], tile.counts.rays[kind]);
    return NULL;
}

PeerCounts peer_draw(const PeerPicture *picture, Framebuffer *framebuffer)
{
    Work work = {.picture = picture, .framebuffer = framebuffer};
    pthread_t helpers[THREADS_MAX];
    uint32_t count = 0;
    while (count + 1 < smaller(picture->threads, THREADS_MAX) &&
           pthread_create(&helpers[count], NULL, draw_tiles, &work) == 0)
        count++;
    draw_tiles(&work);
    while (count > 0)
        pthread_join(helpers[--count], NULL);
    PeerCounts counts;
    for (int kind = 0; kind < RAY_KINDS; kind++)
        counts.rays[kind] = work.rays[kind];
    return counts;
}
