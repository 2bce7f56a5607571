#include "io/part_writer.h"

#include <mutex>

namespace medial::io {

namespace {

/// Parts as text, by the writer of whole documents.
class TextParts final : public PartWriter {
 public:
  TextParts(Target& target, const Format& format) : target_(target), format_(format) {}

  Result<std::shared_ptr<void>> prepare(const PartOutput& output, const Part& part) override {
    auto text = std::make_shared<TextPieces>();
    OutputStream out = OutputStream::to(*text);
    Target own = target_.of_part(part);
    own.out = &out;
    std::unique_lock<std::mutex> alone(projecting_, std::defer_lock);
    if (own.crs.changes_points()) alone.lock();
    Status written = std::visit(
        [&]<class Output>(const Output& one) {
          return std::get<Writer<Output>>(format_.writers)(own, one);
        },
        output);
    if (!written) return std::move(written).error();
    if (!own.status()) return own.status().error();
    if (Status complete = out.finish(); !complete) return std::move(complete).error();
    return std::shared_ptr<void>(std::move(text));
  }

  Status add(void* prepared) override {
    const TextPieces& pieces = *static_cast<const TextPieces*>(prepared);
    for (const TextPiece& piece : pieces) {
      std::string_view text = piece.text();
      // Each row begins with a comma, where there are any; the very first one must not.
      if (!any_ && &piece == &pieces.front() && text.starts_with(",\n")) text.remove_prefix(1);
      any_ = any_ || (begun_ && !text.empty());
      target_.out->put(text);
    }
    begun_ = true;
    return success();
  }

  Status finish() override { return success(); }

 private:
  Target& target_;
  const Format& format_;
  std::mutex projecting_;
  bool begun_ = false, any_ = false;
};

/// Where nobody wants the items themselves.
class NoParts final : public PartWriter {
 public:
  Result<std::shared_ptr<void>> prepare(const PartOutput&, const Part&) override {
    return std::shared_ptr<void>();
  }
  Status add(void*) override { return success(); }
  Status finish() override { return success(); }
};

}  // namespace

Result<std::unique_ptr<PartWriter>> writer_of_parts(Target& target, const Format& format,
                                                    const PartOutput& none) {
  if (format.write_parts != nullptr) return format.write_parts(target, none);
  return std::unique_ptr<PartWriter>(std::make_unique<TextParts>(target, format));
}

std::unique_ptr<PartWriter> writer_of_nothing() { return std::make_unique<NoParts>(); }

}  // namespace medial::io
