// What the stubs of the engine do.

#include "Components/AudioComponent.h"
#include "Internationalization/Culture.h"
#include "Internationalization/Internationalization.h"
#include "Internationalization/StringTable.h"
#include "Internationalization/StringTableCore.h"
#include "Misc/FeedbackContext.h"
#include "Misc/FileHelper.h"
#include "Sound/SoundBase.h"

#include <fstream>
#include <iterator>
#include <map>

std::vector<std::string> StubLog;
static FFeedbackContext Feedback;
FFeedbackContext* GWarn = &Feedback;

std::string StubUtf8(std::u16string_view Text)
{
	std::string Result;
	for (size_t I = 0; I < Text.size(); I++)
	{
		uint32 C = Text[I];
		if (C >= 0xd800 && C < 0xdc00 && I + 1 < Text.size()) C = 0x10000 + ((C - 0xd800) << 10) + (Text[++I] - 0xdc00u);
		const int Rest = C < 0x80 ? 0 : C < 0x800 ? 1 : C < 0x10000 ? 2 : 3;
		const uint32 Starts[] = {0, 0xc0, 0xe0, 0xf0};
		Result.push_back(static_cast<char>(Starts[Rest] | (C >> (6 * Rest))));
		for (int R = Rest - 1; R >= 0; R--) Result.push_back(static_cast<char>(0x80 | ((C >> (6 * R)) & 0x3f)));
	}
	return Result;
}

std::u16string StubUtf16(std::string_view Text)
{
	std::u16string Result;
	for (size_t I = 0; I < Text.size();)
	{
		const uint8 First = static_cast<uint8>(Text[I]);
		const size_t Length = First < 0x80 ? 1 : First >= 0xf0 ? 4 : First >= 0xe0 ? 3 : First >= 0xc0 ? 2 : 0;
		if (Length == 0 || I + Length > Text.size())
		{
			Result.push_back(u'?');
			I++;
			continue;
		}
		uint32 C = Length == 1 ? First : First & (0x7fu >> Length);
		for (size_t K = 1; K < Length; K++) C = (C << 6) | (static_cast<uint8>(Text[I + K]) & 0x3fu);
		I += Length;
		if (C >= 0x10000) Result.push_back(static_cast<TCHAR>(0xd800 + ((C - 0x10000) >> 10)));
		Result.push_back(static_cast<TCHAR>(C >= 0x10000 ? 0xdc00 + ((C - 0x10000) & 0x3ff) : C));
	}
	return Result;
}

std::string StubFormat(const TCHAR* Format, const std::vector<std::string>& Arguments)
{
	std::string Result;
	const std::string Text = StubUtf8(Format);
	size_t Next = 0;
	for (size_t I = 0; I < Text.size(); I++)
	{
		if (Text[I] == '%') Result += Arguments.at(Next++), I++;
		else Result.push_back(Text[I]);
	}
	if (Next != Arguments.size()) std::abort();
	return Result;
}

FString FString::Replace(const TCHAR* From, const TCHAR* To) const
{
	std::u16string Result = Data;
	const std::u16string Old(From), New(To);
	for (size_t At = 0; (At = Result.find(Old, At)) != std::u16string::npos; At += New.size()) Result.replace(At, Old.size(), New);
	return FString(Result);
}

FName::FName(const TCHAR* InText)
{
	static std::map<std::string, FString> Names;
	const FString Spelled(InText);
	if (Spelled.Len() >= NAME_SIZE) std::abort();
	if (Spelled.IsEmpty()) return;
	Text = &Names.try_emplace(Spelled.ToLower().Utf8(), Spelled).first->second;
}

static std::map<std::string, const UStringTable*> Tables;

FText FText::FromStringTable(FName Table, const FString& Key)
{
	FString Found = TEXT("<MISSING STRING TABLE ENTRY>");
	const auto Place = Tables.find(Table.ToString().Utf8());
	if (Place != Tables.end()) Place->second->GetStringTable()->GetSourceString(FTextKey(Key), Found);
	return FText::FromString(Found);
}

UStringTable::UStringTable() : StubTable(MakeShared<FStringTable>())
{
	Tables["Stub"] = this;
}

bool FFileHelper::LoadFileToArray(TArray<uint8>& Result, const TCHAR* Filename)
{
	std::ifstream File(StubUtf8(Filename), std::ios::binary);
	const std::vector<char> Bytes((std::istreambuf_iterator<char>(File)), {});
	Result.Reset();
	Result.Append(reinterpret_cast<const uint8*>(Bytes.data()), static_cast<int32>(Bytes.size()));
	return static_cast<bool>(File);
}

static std::vector<UObject*> Objects;

UObject::UObject()
{
	Objects.push_back(this);
}

UClass* UObject::StaticClass()
{
	static UClass Found = {"UObject", nullptr};
	return &Found;
}

void StubCollectGarbage()
{
	for (UObject* Object : Objects) delete Object;
	Objects.clear();
}

FInternationalization& FInternationalization::Get()
{
	static FInternationalization Only;
	if (!Only.StubLanguage.IsValid()) Only.StubLanguage = MakeShared<FCulture>();
	return Only;
}

void UAudioComponent::SetSound(USoundBase* NewSound)
{
	Stop();
	Sound = NewSound;
}

void UAudioComponent::Play(float StartTime)
{
	if (Sound == nullptr || !bStubHasDevice) return;
	StubState = EAudioComponentPlayState::Playing;
	StubStart = StartTime;
	bStubReports = OnAudioPlaybackPercentNative.IsBound();
}

void UAudioComponent::SetPaused(bool bPause)
{
	if (IsPlaying()) StubState = bPause ? EAudioComponentPlayState::Paused : EAudioComponentPlayState::Playing;
}

void UAudioComponent::StubReport(const USoundWave* Wave, float Fraction)
{
	if (bStubReports) OnAudioPlaybackPercentNative.Broadcast(this, Wave, Fraction);
}
