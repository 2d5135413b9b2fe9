#include "tests/samples/exr_files.h"

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatVectorAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfPreviewImage.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringVectorAttribute.h>
#include <OpenEXR/ImfTileDescription.h>
#include <OpenEXR/ImfTiledOutputPart.h>

namespace walr::test {
namespace {

Imf::Header headerOf(const ExrPart& part, const ExrFileWish& wish, bool first) {
  Imf::Header header(wish.display, part.data);
  header.compression() = part.compression;
  header.setType(part.tile > 0 ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE);
  if (!part.name.empty()) header.setName(part.name);
  if (!part.view.empty()) header.setView(part.view);
  if (part.tile > 0) {
    const auto side = static_cast<unsigned>(part.tile);
    header.setTileDescription({side, side, Imf::ONE_LEVEL});
  }
  for (const std::string& channel : part.channels) header.channels().insert(channel, Imf::Channel(Imf::HALF));
  if (first && !wish.views.empty()) header.insert("multiView", Imf::StringVectorAttribute(wish.views));
  if (first && wish.manyAttributes) {
    header.insert("matrix", Imf::M44fAttribute());
    header.insert("numbers", Imf::FloatVectorAttribute(Imf::FloatVector{1.0F, 2.0F}));
    header.insert("words", Imf::StringVectorAttribute(Imf::StringVector{"a", "bc"}));
    header.setPreviewImage(Imf::PreviewImage(2, 1));
  }
  return header;
}

}  // namespace

std::string exrBytes(const ExrFileWish& wish) {
  std::vector<Imf::Header> headers;
  for (const ExrPart& part : wish.parts) headers.push_back(headerOf(part, wish, headers.empty()));
  Imf::StdOSStream stream;
  {
    Imf::MultiPartOutputFile file(stream, headers.data(), static_cast<int>(headers.size()));
    for (std::size_t p = 0; p < wish.parts.size(); ++p) {
      const ExrPart& part = wish.parts[p];
      const Imath::V2i size = part.data.size() + Imath::V2i(1);
      std::vector<std::vector<Imath::half>> planes;
      Imf::FrameBuffer buffer;
      for (const std::string& channel : part.channels) {
        std::vector<Imath::half>& plane = planes.emplace_back();
        for (int y = part.data.min.y; y <= part.data.max.y; ++y) {
          for (int x = part.data.min.x; x <= part.data.max.x; ++x) {
            plane.emplace_back(part.factor * valueAt(x, y, static_cast<int>(planes.size()) - 1));
          }
        }
        buffer.insert(channel, Imf::Slice::Make(Imf::HALF, plane.data(), part.data.min, size.x, size.y));
      }
      if (part.tile > 0) {
        Imf::TiledOutputPart output(file, static_cast<int>(p));
        output.setFrameBuffer(buffer);
        output.writeTiles(0, output.numXTiles() - 1, 0, output.numYTiles() - 1);
      } else {
        Imf::OutputPart output(file, static_cast<int>(p));
        output.setFrameBuffer(buffer);
        output.writePixels(size.y);
      }
    }
  }
  return stream.str();
}

}  // namespace walr::test
