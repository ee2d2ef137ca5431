// SPDX-License-Identifier: MIT
// Wraps OpenImageIO in a C function that catches every exception.
#include "image/read_exr.h"

#include <OpenImageIO/imageio.h>

#include <cstdio>
#include <exception>
#include <string>

namespace
{

bool read_picture(const char *path, const ExrPicture &picture, std::string &message)
{
    auto input = OIIO::ImageInput::open(path);
    if (!input) {
        message = OIIO::geterror();
        return false;
    }
    const OIIO::ImageSpec &spec = input->spec();
    if (spec.width != picture.width || spec.height != picture.height || spec.nchannels < 3) {
        message = "the picture has another size";
        return false;
    }
    const bool ok = input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, picture.pixels);
    if (!ok)
        message = input->geterror();
    return ok;
}

} // namespace

int read_exr(const char *path, const ExrPicture *picture, char *message, size_t message_size)
{
    std::string text;
    bool ok = false;
    try {
        ok = read_picture(path, *picture, text);
    } catch (const std::exception &failure) {
        text = failure.what();
    } catch (...) {
        text = "an unknown exception";
    }
    std::snprintf(message, message_size, "%s: %s", path, text.c_str());
    return ok;
}
