// SPDX-License-Identifier: MIT
// The whole of the C++ in clrt: OpenImageIO behind a C function, with every exception caught.
#include "image/image_module.h"

#include <OpenImageIO/imageio.h>

#include <cstdio>
#include <exception>
#include <string>

namespace
{

bool write_picture(const ImageModulePicture &picture, std::string &message)
{
    auto output = OIIO::ImageOutput::create(picture.format);
    if (!output) {
        message = OIIO::geterror();
        return false;
    }
    const auto type = picture.is_float ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8;
    OIIO::ImageSpec spec(picture.width, picture.height, 3, type);
    // Without it OpenEXR and TIFF write the time, and no two files would be equal.
    spec.attribute("DateTime", "");
    spec.attribute("CompressionQuality", 95);
    for (size_t i = 0; i < picture.text_count; i++)
        spec.attribute(picture.texts[2 * i], picture.texts[2 * i + 1]);
    const bool ok = output->open(picture.path, spec) && output->write_image(type, picture.pixels) &&
                    output->close();
    if (!ok)
        message = output->geterror();
    return ok;
}

} // namespace

int clrt_image_module_write(const ImageModulePicture *picture, char *message, size_t message_size)
{
    std::string text;
    bool ok = false;
    try {
        ok = write_picture(*picture, text);
    } catch (const std::exception &failure) {
        text = failure.what();
    } catch (...) {
        text = "an unknown exception";
    }
    std::snprintf(message, message_size, "%s", text.c_str());
    return ok;
}
