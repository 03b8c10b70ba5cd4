#include "core/formats/file_kind.h"

#include <algorithm>
#include <array>

namespace dwell {
namespace {

using namespace std::string_view_literals;

struct Signature {
  std::string_view bytes;
  const char* kind;
};

constexpr std::array kSignatures{Signature{"\x89PNG\r\n"sv, "a PNG image"},
                                 Signature{"PK\x03\x04"sv, "a ZIP archive (such as .npz or .xlsx)"},
                                 Signature{"PK\x05\x06"sv, "an empty ZIP archive"},
                                 Signature{"MATLAB 5.0 MAT-file"sv, "a MATLAB .mat file"},
                                 Signature{"MATLAB 7.3 MAT-file"sv, "a MATLAB 7.3 .mat file"},
                                 Signature{"\x1f\x8b"sv, "a gzip file (unpack it)"},
                                 Signature{"\xff\xd8\xff"sv, "a JPEG image"},
                                 Signature{"II*\0"sv, "a TIFF image"},
                                 Signature{"MM\0*"sv, "a TIFF image"},
                                 Signature{"GIF8"sv, "a GIF image"},
                                 Signature{"\xd0\xcf\x11\xe0"sv, "an old Microsoft Office file (such as .xls)"},
                                 Signature{"%PDF"sv, "a PDF document"},
                                 Signature{"\xff\xfe"sv, "UTF-16 text (save it as UTF-8)"},
                                 Signature{"\xfe\xff"sv, "UTF-16 text (save it as UTF-8)"}};

bool is_control(char c) {
  const auto u = static_cast<unsigned char>(c);
  return u < 0x20 && c != '\t' && c != '\n' && c != '\r' && c != '\f';
}

}  // namespace

std::string kind_of_binary(std::string_view bytes) {
  for (const Signature& signature : kSignatures) {
    if (bytes.starts_with(signature.bytes)) return signature.kind;
  }
  constexpr std::size_t kSniffed = 65536;
  const std::string_view head = bytes.substr(0, kSniffed);
  return std::any_of(head.begin(), head.end(), is_control) ? "binary data" : "";
}

}  // namespace dwell
