// SPDX-License-Identifier: MIT
// The target has two framebuffers. OpenGL draws into the first framebuffer. A blit copies the first
// to the second framebuffer, which is displayed. If the first is twice as large, the blit averages
// pixels.
#include "view/draw/target.h"

#include <stdlib.h>

void target_open(Target *target)
{
    *target = (Target){0};
    glGenFramebuffers(2, target->frames);
    glGenRenderbuffers(3, target->buffers);
}

void target_close(Target *target)
{
    glDeleteFramebuffers(2, target->frames);
    glDeleteRenderbuffers(3, target->buffers);
    *target = (Target){0};
}

static void size_buffer(GLuint buffer, GLenum format, uint32_t width, uint32_t height)
{
    glBindRenderbuffer(GL_RENDERBUFFER, buffer);
    glRenderbufferStorage(GL_RENDERBUFFER, format, (GLsizei)width, (GLsizei)height);
}

static bool attach(GLuint frame, GLuint color, GLuint depth, Error *error)
{
    glBindFramebuffer(GL_FRAMEBUFFER, frame);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color);
    if (depth != 0)
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
    return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE ||
           error_set(error, "OpenGL makes no framebuffer of the window's size");
}

static bool resize(Target *target, Error *error)
{
    const uint32_t width = target->width, height = target->height, factor = target->factor;
    size_buffer(target->buffers[0], GL_RGBA8, width * factor, height * factor);
    size_buffer(target->buffers[1], GL_DEPTH_COMPONENT32F, width * factor, height * factor);
    size_buffer(target->buffers[2], GL_RGBA8, width, height);
    return attach(target->frames[0], target->buffers[0], target->buffers[1], error) &&
           attach(target->frames[1], target->buffers[2], 0, error);
}

bool target_begin(Target *target, uint32_t width, uint32_t height, uint32_t factor, Error *error)
{
    const bool fits =
        target->width == width && target->height == height && target->factor == factor;
    target->width = width;
    target->height = height;
    target->factor = factor;
    if (!fits && !resize(target, error)) {
        target->width = 0;
        return false;
    }
    glBindFramebuffer(GL_FRAMEBUFFER, target->frames[0]);
    glViewport(0, 0, (GLsizei)(width * factor), (GLsizei)(height * factor));
    return true;
}

static void copy(const Target *target, GLuint from, GLuint to, uint32_t factor)
{
    const GLint width = (GLint)target->width, height = (GLint)target->height;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, from);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
    glBlitFramebuffer(0, 0, width * (GLint)factor, height * (GLint)factor, 0, 0, width, height,
                      GL_COLOR_BUFFER_BIT, factor == 1 ? GL_NEAREST : GL_LINEAR);
}

void target_show(const Target *target)
{
    copy(target, target->frames[0], target->frames[1], target->factor);
    copy(target, target->frames[1], 0, 1);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, (GLsizei)target->width, (GLsizei)target->height);
}

// Converts bytes to floats. Reverses the rows, because OpenGL's first row is at the bottom.
static void store_rows(Framebuffer *framebuffer, const unsigned char *bytes)
{
    const size_t width = framebuffer->width, height = framebuffer->height;
    float *values = (float *)framebuffer->pixels;
    for (size_t row = 0; row < height; row++)
        for (size_t i = 0; i < 3 * width; i++)
            values[3 * width * row + i] = (float)bytes[3 * width * (height - 1 - row) + i] / 255;
}

bool target_read(const Target *target, Framebuffer *framebuffer, Error *error)
{
    unsigned char *bytes = memory_raw((size_t)target->width * target->height, 3, error);
    const bool ok =
        bytes != NULL && framebuffer_make(framebuffer, target->width, target->height, error);
    if (ok) {
        glBindFramebuffer(GL_READ_FRAMEBUFFER, target->frames[1]);
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        glReadPixels(0, 0, (GLsizei)target->width, (GLsizei)target->height, GL_RGB,
                     GL_UNSIGNED_BYTE, bytes);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
        store_rows(framebuffer, bytes);
    }
    free(bytes);
    return ok;
}
