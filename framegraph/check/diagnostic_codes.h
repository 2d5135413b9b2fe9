#pragma once

#include <string_view>

/// The codes of all diagnostics. A code never changes its meaning.
namespace fg::code {

inline constexpr std::string_view kInvalidHandle = "FG001";      ///< Handle that is empty or belongs to another graph.
inline constexpr std::string_view kReadNeverWritten = "FG002";   ///< Read of contents that no pass writes.
inline constexpr std::string_view kCycle = "FG003";              ///< Passes that wait for each other.
inline constexpr std::string_view kStaleVersionRead = "FG004";   ///< A version read after it was overwritten.
inline constexpr std::string_view kTwoWriters = "FG005";         ///< One version written twice.
inline constexpr std::string_view kReadAndWritten = "FG006";     ///< By one pass, but not declared as an update.
inline constexpr std::string_view kFormatUnsupported = "FG007";  ///< This device lacks the format for the declared use.
inline constexpr std::string_view kExtentMismatch = "FG008";     ///< Of a pass and its texture, or of two attachments.
inline constexpr std::string_view kImportWithoutState = "FG009";   ///< Import without a state, or read in UNDEFINED.
inline constexpr std::string_view kExportNeverWritten = "FG010";   ///< No pass writes the exported version.
inline constexpr std::string_view kExportOverwritten = "FG011";    ///< A later version overwrites the exported one.
inline constexpr std::string_view kExportedTwice = "FG012";        ///< One resource has two exports.
inline constexpr std::string_view kExportWithoutLayout = "FG013";  ///< Texture released in layout UNDEFINED.
inline constexpr std::string_view kHistoryNeverWritten = "FG014";  ///< `previous` is used, `current` never written.
inline constexpr std::string_view kHistoryWrittenTwice = "FG015";  ///< Or only in part.
inline constexpr std::string_view kHistoryMismatch = "FG016";      ///< Its two images are described differently.
inline constexpr std::string_view kBindingNotInShader = "FG017";   ///< Declared, but the shader has no such variable.
inline constexpr std::string_view kBindingNotDeclared = "FG018";   ///< Binding in the shader, but not declared.
inline constexpr std::string_view kBindingAccess = "FG019";        ///< The shader accesses it differently.
inline constexpr std::string_view kBindingFormat = "FG020";        ///< Shader and texture have different formats.
inline constexpr std::string_view kPushConstantSize = "FG021";     ///< Differs from the size of the shader's block.
inline constexpr std::string_view kUnknownConstant = "FG022";      ///< Specialization constant not in the shader.
inline constexpr std::string_view kConstantNotSet = "FG023";       ///< Specialization constant without a value.
inline constexpr std::string_view kDuplicateName = "FG024";        ///< Two passes or two resources have one name.
inline constexpr std::string_view kEmptyExtent = "FG025";          ///< Texture or buffer of size zero.
inline constexpr std::string_view kEmptyDispatch = "FG026";        ///< Zero work groups.
inline constexpr std::string_view kSubresourceRange = "FG027";     ///< Mip levels or layers that do not exist.
inline constexpr std::string_view kPassWithoutEffect = "FG028";    ///< Warning: the pass is culled.
inline constexpr std::string_view kAccessKind = "FG029";           ///< Buffer accessed as a texture, or the reverse.
inline constexpr std::string_view kReadOnlyWritten = "FG030";      ///< Upload or previous history written.
inline constexpr std::string_view kHistoryAge = "FG031";           ///< Of no history, or outside the push constants.
inline constexpr std::string_view kIndirectArguments = "FG032";    ///< Misaligned, or past the end of the buffer.
inline constexpr std::string_view kTwoLayouts = "FG033";           ///< Two reads in one pass need two layouts.
inline constexpr std::string_view kBindingTwice = "FG034";         ///< Two accesses are bound to one shader variable.
inline constexpr std::string_view kBufferTooSmall = "FG035";       ///< Smaller than the shader's uniform block.
inline constexpr std::string_view kUnreadStandIn = "FG036";        ///< Stand-in that the pass does not read otherwise.
inline constexpr std::string_view kTooLarge = "FG037";             ///< Larger than any device allows.

}  // namespace fg::code
