// SPDX-License-Identifier: MIT
// All of clrt's C++ code: two C functions that call OpenImageIO and catch every exception.
#include "image/image_module.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string>
#include <vector>

namespace
{

// TIFF and JPEG have no fields with custom names, so clrt:NAME texts are lines of a description.
void describe_origin(OIIO::ImageSpec &spec, const ImageModulePicture &picture)
{
    std::string lines;
    const std::string format = picture.format;
    for (size_t i = 0; i < picture.text_count; i++) {
        const std::string name = picture.texts[2 * i], value = picture.texts[2 * i + 1];
        spec.attribute(name, value);
        if (name.rfind("clrt:", 0) == 0)
            lines += name + "=" + value + "\n";
    }
    if (!lines.empty() && (format == "tiff" || format == "jpeg"))
        spec.attribute("ImageDescription", lines);
}

// Sets the frame rate of an animation. OpenImageIO 2.5 applies a rate only to the writer's next
// file. The code therefore first opens and closes a file in memory.
void set_frame_rate(OIIO::ImageOutput &output, OIIO::ImageSpec &spec)
{
    spec.attribute("FramesPerSecond", 20.0f);
    OIIO::ImageSpec previous(1, 1, 3, OIIO::TypeDesc::UINT8);
    previous.extra_attribs = spec.extra_attribs;
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    if (output.supports("ioproxy") && output.set_ioproxy(&memory)) {
        output.open("unused", previous);
        output.close();
    }
}

// Writes an animation as subimages.
bool write_frames(OIIO::ImageOutput &output, const OIIO::ImageSpec &whole,
                  const ImageModulePicture &picture)
{
    OIIO::ImageSpec spec = whole;
    spec.height = spec.full_height = picture.height / picture.frames;
    const char *pixels = static_cast<const char *>(picture.pixels);
    const std::vector<OIIO::ImageSpec> specs(static_cast<size_t>(picture.frames), spec);
    bool ok = output.open(picture.path, picture.frames, specs.data());
    for (int frame = 0; ok && frame < picture.frames; frame++)
        ok = (frame == 0 || output.open(picture.path, spec, OIIO::ImageOutput::AppendSubimage)) &&
             output.write_image(spec.format,
                                pixels + spec.image_bytes() * static_cast<size_t>(frame));
    return ok;
}

// Writes the picture. Closes the writer even after a failure, because the caller then frees the
// memory to which the writer writes.
bool write_all(OIIO::ImageOutput &output, const OIIO::ImageSpec &spec,
               const ImageModulePicture &picture)
{
    const bool written = picture.frames > 0 ? write_frames(output, spec, picture)
                         : !output.open(picture.path, spec)
                             ? false
                             : output.write_image(spec.format, picture.pixels);
    return output.close() && written;
}

// Writes to memory first if the format supports it. On a full disk, some writers report no error,
// and libjpeg ends the process.
bool write_through_memory(OIIO::ImageOutput &output, const OIIO::ImageSpec &spec,
                          const ImageModulePicture &picture)
{
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const bool in_memory = output.supports("ioproxy") && output.set_ioproxy(&memory);
    const bool ok = write_all(output, spec, picture);
    if (!ok || !in_memory)
        return ok;
    FILE *file = std::fopen(picture.path, "wb");
    if (file == nullptr)
        return false;
    const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
    return std::fclose(file) == 0 && written;
}

bool write_picture(const ImageModulePicture &picture, std::string &message)
{
    auto output = OIIO::ImageOutput::create(picture.format);
    if (!output) {
        message = OIIO::geterror();
        return false;
    }
    const auto type = picture.is_float ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8;
    OIIO::ImageSpec spec(picture.width, picture.height, 3, type);
    // Without this attribute, TIFF stores the current time, and equal pictures make different
    // files.
    spec.attribute("DateTime", "");
    spec.attribute("CompressionQuality", 95);
    describe_origin(spec, picture);
    if (picture.frames > 0)
        set_frame_rate(*output, spec);
    errno = 0;
    const bool ok = write_through_memory(*output, spec, picture);
    if (!ok)
        message = errno != 0 ? std::strerror(errno) : output->geterror();
    return ok;
}

bool check_head(const OIIO::ImageSpec &spec, uint64_t values_max, std::string &message)
{
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1 || spec.depth > 1)
        message = "it holds no flat picture";
    else if (spec.deep)
        message = "deep pictures are not read";
    else if (spec.nchannels > STORED_CHANNELS_MAX ||
             uint64_t(spec.width) * uint64_t(spec.height) > values_max / uint64_t(spec.nchannels))
        message = "it is too large";
    return message.empty();
}

void fill_head(const OIIO::ImageSpec &spec, ImageModuleContent &content)
{
    StoredImage &image = content.image;
    image.width = uint32_t(spec.width);
    image.height = uint32_t(spec.height);
    image.channel_count = uint32_t(spec.nchannels);
    content.is_8_bit = spec.format == OIIO::TypeDesc::UINT8 && spec.channelformats.empty();
    for (int i = 0; i < spec.nchannels; i++)
        std::snprintf(image.names[i], sizeof image.names[i], "%s", spec.channel_name(i).c_str());
    for (int i = 0; i < STORED_TEXTS; i++)
        std::snprintf(image.texts[i], sizeof image.texts[i], "%s",
                      std::string(spec.get_string_attribute(content.text_names[i])).c_str());
}

bool is_color(const std::string &name)
{
    return name == "R" || name == "G" || name == "B" || name == "Y" || name == "A";
}

bool holds_ids(const OIIO::ImageSpec &spec, int channel)
{
    return spec.channelformat(channel) == OIIO::TypeDesc::UINT32 &&
           !is_color(spec.channel_name(channel));
}

// Reads all channels. A channel of 32-bit integers that is not a color contains ids, which are
// stored unchanged. Other channels are converted to `type`. Each call of read_image reads
// neighboring channels, either all with ids or all without ids.
bool read_channels(OIIO::ImageInput &input, const OIIO::ImageSpec &spec, OIIO::TypeDesc type,
                   void *values)
{
    const auto size = static_cast<OIIO::stride_t>(type.size());
    bool ok = true;
    for (int first = 0, end = 0; ok && first < spec.nchannels; first = end) {
        const bool integer = holds_ids(spec, first);
        while (end < spec.nchannels && holds_ids(spec, end) == integer)
            end++;
        ok = input.read_image(0, 0, first, end, integer ? OIIO::TypeDesc::UINT32 : type,
                              static_cast<char *>(values) + first * size, spec.nchannels * size);
    }
    return ok;
}

bool read_picture(const char *path, const char *format, ImageModuleContent &content,
                  std::string &message)
{
    auto input = OIIO::ImageInput::create(format);
    OIIO::ImageSpec spec;
    if (!input || !input->open(path, spec)) {
        message = input ? input->geterror() : OIIO::geterror();
        return false;
    }
    if (!check_head(spec, content.values_max, message))
        return false;
    fill_head(spec, content);
    const OIIO::TypeDesc type = content.is_8_bit ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT;
    content.values = std::malloc(size_t(spec.width) * size_t(spec.height) * size_t(spec.nchannels) *
                                 type.size());
    if (content.values == nullptr) {
        message = "memory ran out";
        return false;
    }
    const bool ok = read_channels(*input, spec, type, content.values);
    message = input->geterror();
    return ok;
}

// Returns whether `work` succeeds without an exception. Otherwise, stores the reason in `message`.
template <typename Work> int guarded(char *message, size_t message_size, Work work)
{
    std::string text;
    bool ok = false;
    try {
        ok = work(text);
    } catch (const std::exception &failure) {
        text = failure.what();
    } catch (...) {
        text = "an unknown exception";
    }
    std::snprintf(message, message_size, "%s", text.c_str());
    return ok;
}

} // namespace

int clrt_image_module_read(const char *path, const char *format, ImageModuleContent *content,
                           char *message, size_t message_size)
{
    return guarded(message, message_size,
                   [&](std::string &text) { return read_picture(path, format, *content, text); });
}

int clrt_image_module_write(const ImageModulePicture *picture, char *message, size_t message_size)
{
    return guarded(message, message_size,
                   [&](std::string &text) { return write_picture(*picture, text); });
}
