// SPDX-License-Identifier: MIT
// The whole of the C++ in clrt: OpenImageIO behind a C function, with every exception caught.
#include "image/image_module.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <vector>

namespace
{

// Some writers do not notice a full disk, and libjpeg ends the process at one.  Where the format
// can be written to memory, it is, and the bytes then go to the file here.
bool write_bytes(const std::vector<unsigned char> &bytes, const char *path)
{
    FILE *file = std::fopen(path, "wb");
    if (file == nullptr)
        return false;
    const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
    return std::fclose(file) == 0 && written;
}

bool write_picture(const ImageModulePicture &picture, std::string &message)
{
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
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
    const bool in_memory = output->supports("ioproxy") && output->set_ioproxy(&memory);
    const bool ok = output->open(picture.path, spec) && output->write_image(type, picture.pixels) &&
                    output->close();
    if (!ok)
        message = output->geterror();
    else if (in_memory && !write_bytes(bytes, picture.path))
        message = std::strerror(errno);
    return message.empty() && ok;
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
