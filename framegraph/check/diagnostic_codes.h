#pragma once

#include <string_view>

/// The codes of all diagnostics. Stable: a code never changes its meaning.
namespace fg::code {

inline constexpr std::string_view kInvalidHandle = "FG001";      ///< Empty, or of another graph.
inline constexpr std::string_view kReadNeverWritten = "FG002";   ///< Contents that nobody makes.
inline constexpr std::string_view kCycle = "FG003";              ///< Passes that wait for each other.
inline constexpr std::string_view kStaleVersionRead = "FG004";   ///< A version read after it was overwritten.
inline constexpr std::string_view kTwoWriters = "FG005";         ///< One version written twice.
inline constexpr std::string_view kReadAndWritten = "FG006";     ///< Twice in one pass, not declared in place.
inline constexpr std::string_view kFormatUnsupported = "FG007";  ///< On this device, for the declared use.
inline constexpr std::string_view kExtentMismatch = "FG008";  ///< Between producer and consumer, or among attachments.
inline constexpr std::string_view kImportWithoutState = "FG009";   ///< Read, but its state has no contents.
inline constexpr std::string_view kExportNeverWritten = "FG010";   ///< Nobody makes what the host is to get.
inline constexpr std::string_view kExportOverwritten = "FG011";    ///< Not the last version.
inline constexpr std::string_view kExportedTwice = "FG012";        ///< One resource, two states.
inline constexpr std::string_view kExportWithoutLayout = "FG013";  ///< Release into UNDEFINED.
inline constexpr std::string_view kHistoryNeverWritten = "FG014";  ///< `previous` read, `current` never written.
inline constexpr std::string_view kHistoryWrittenTwice = "FG015";  ///< Or only in part.
inline constexpr std::string_view kHistoryChanged = "FG016";       ///< Another description without a reset.
inline constexpr std::string_view kBindingNotInShader = "FG017";   ///< Declared, but the shader has no such variable.
inline constexpr std::string_view kBindingNotDeclared = "FG018";   ///< In the shader, but not declared.
inline constexpr std::string_view kBindingAccess = "FG019";        ///< Shader and declaration differ on the access.
inline constexpr std::string_view kBindingFormat = "FG020";        ///< Shader and texture differ on the format.
inline constexpr std::string_view kPushConstantSize = "FG021";     ///< Not what the shader's block takes.
inline constexpr std::string_view kUnknownConstant = "FG022";      ///< Specialization constant not in the shader.
inline constexpr std::string_view kConstantNotSet = "FG023";       ///< Specialization constant without a value.
inline constexpr std::string_view kDuplicateName = "FG024";        ///< Of two passes, or of two resources.
inline constexpr std::string_view kEmptyExtent = "FG025";          ///< Texture or buffer of size zero.
inline constexpr std::string_view kEmptyDispatch = "FG026";        ///< Zero work groups.
inline constexpr std::string_view kSubresourceRange = "FG027";     ///< Mip levels or layers that do not exist.
inline constexpr std::string_view kPassWithoutEffect = "FG028";    ///< Warning: the pass is culled.
inline constexpr std::string_view kAccessKind = "FG029";           ///< Buffer accessed as a texture, or the reverse.
inline constexpr std::string_view kReadOnlyWritten = "FG030";      ///< Upload or previous history written.
inline constexpr std::string_view kHistoryAge = "FG031";           ///< Of no history, or outside the push constants.
inline constexpr std::string_view kIndirectArguments = "FG032";    ///< Misaligned, or past the end of the buffer.
inline constexpr std::string_view kTwoLayouts = "FG033";           ///< Two reads in one pass need two layouts.
inline constexpr std::string_view kBindingTwice = "FG034";         ///< One shader variable, two accesses.
inline constexpr std::string_view kBufferTooSmall = "FG035";       ///< Smaller than the shader's uniform block.
inline constexpr std::string_view kUnreadTexture = "FG036";        ///< Stand-in that the pass does not read otherwise.

}  // namespace fg::code
