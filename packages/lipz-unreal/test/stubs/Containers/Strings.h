#pragma once

#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

using uint8 = std::uint8_t;
using int32 = std::int32_t;
using uint32 = std::uint32_t;
using int64 = signed long long;
using uint64 = unsigned long long;
using ANSICHAR = char;
using TCHAR = char16_t;
#define TEXT(x) u##x
#define MAX_uint32 0xffffffffu
#define NAME_SIZE 1024
#define INDEX_NONE (-1)

struct FChar
{
	static bool IsLower(TCHAR C) { return C >= u'a' && C <= u'z'; }
	static bool IsAlnum(TCHAR C) { return IsLower(C) || (C >= u'A' && C <= u'Z') || (C >= u'0' && C <= u'9'); }
	static TCHAR ToLower(TCHAR C) { return C >= u'A' && C <= u'Z' ? static_cast<TCHAR>(C + 32) : C; }
};

/** UTF-8 from UTF-16. */
std::string StubUtf8(std::u16string_view Text);
/** UTF-16 from UTF-8; a question mark for each invalid byte. */
std::u16string StubUtf16(std::string_view Text);

class FStringView
{
public:
	FStringView(const TCHAR* Data, int32 Length) : View(Data, static_cast<size_t>(Length)) {}
	std::u16string_view View;
};

/** Comparisons ignore case, as those of Unreal do. */
class FString
{
public:
	FString() = default;
	FString(const TCHAR* Text) : Data(Text) {}
	explicit FString(FStringView Text) : Data(Text.View) {}
	explicit FString(std::u16string Text) : Data(std::move(Text)) {}
	const TCHAR* operator*() const { return Data.c_str(); }
	TCHAR operator[](int32 Index) const { return Data.at(static_cast<size_t>(Index)); }
	int32 Len() const { return static_cast<int32>(Data.size()); }
	bool IsEmpty() const { return Data.empty(); }
	void Reset() { Data.clear(); }
	void AppendChar(TCHAR C) { Data.push_back(C); }
	auto begin() const { return Data.begin(); }
	auto end() const { return Data.end(); }
	FString ToLower() const
	{
		std::u16string Lower = Data;
		for (TCHAR& C : Lower) C = FChar::ToLower(C);
		return FString(Lower);
	}
	FString Left(int32 Count) const { return FString(Data.substr(0, static_cast<size_t>(Count))); }
	FString Mid(int32 Start) const { return FString(Data.substr(static_cast<size_t>(Start))); }
	bool FindChar(TCHAR C, int32& Index) const
	{
		const size_t Found = Data.find(C);
		Index = Found == std::u16string::npos ? INDEX_NONE : static_cast<int32>(Found);
		return Index != INDEX_NONE;
	}
	FString Replace(const TCHAR* From, const TCHAR* To) const;
	bool StartsWith(const FString& Start) const
	{
		return ToLower().Data.compare(0, Start.Data.size(), Start.ToLower().Data) == 0;
	}
	template <typename... T> static FString Printf(const TCHAR* Format, T... Arguments);
	friend bool operator==(const FString& A, const FString& B) { return A.ToLower().Data == B.ToLower().Data; }
	friend FString operator+(const FString& A, const FString& B) { return FString(A.Data + B.Data); }
	/** The text in UTF-8, for tests. */
	std::string Utf8() const { return StubUtf8(Data); }

private:
	std::u16string Data;
};

/** Formats %s, %d and %u; each argument is in UTF-8. */
std::string StubFormat(const TCHAR* Format, const std::vector<std::string>& Arguments);
inline std::string StubArgument(const TCHAR* Text) { return StubUtf8(Text); }
inline std::string StubArgument(int32 Number) { return std::to_string(Number); }
inline std::string StubArgument(uint32 Number) { return std::to_string(Number); }

template <typename... T> FString FString::Printf(const TCHAR* Format, T... Arguments)
{
	return FString(StubUtf16(StubFormat(Format, {StubArgument(Arguments)...})));
}

class FUTF8ToTCHAR
{
public:
	FUTF8ToTCHAR(const char* Text, int32 Length) : Data(StubUtf16({Text, static_cast<size_t>(Length)})) {}
	const TCHAR* Get() const { return Data.c_str(); }
	int32 Length() const { return static_cast<int32>(Data.size()); }

private:
	std::u16string Data;
};

class FTCHARToUTF8
{
public:
	explicit FTCHARToUTF8(const TCHAR* Text) : Data(StubUtf8(Text)) {}
	const ANSICHAR* Get() const { return Data.c_str(); }
	int32 Length() const { return static_cast<int32>(Data.size()); }

private:
	std::string Data;
};

/** An interned name. Unreal stops if a name is too long. */
class FName
{
public:
	FName() = default;
	FName(const TCHAR* Text);
	bool IsNone() const { return Text == nullptr; }
	FString ToString() const { return Text == nullptr ? FString(TEXT("None")) : *Text; }
	friend bool operator==(FName A, FName B) { return A.Text == B.Text; }

private:
	const FString* Text = nullptr;
};

/** A display text. */
class FText
{
public:
	static FText FromString(FString Text) { FText Made; Made.Text = std::move(Text); return Made; }
	static FText FromStringTable(FName Table, const FString& Key);
	bool IsEmpty() const { return Text.IsEmpty(); }
	const FString& ToString() const { return Text; }

private:
	FString Text;
};
