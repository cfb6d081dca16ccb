#include "LipzBank.h"

#include "Internationalization/Culture.h"
#include "Internationalization/Internationalization.h"
#include "LipzDialogue.h"
#include "LipzLog.h"
#include "LipzStrings.h"
#include "Misc/FileHelper.h"

namespace
{
	TSharedPtr<FLipzDialogue> OpenFiles(const TArray<uint8>& Base, const TArray<TArray<uint8>>& Added, FString& Error)
	{
		TArray<lipz_bytes> Contents;
		Contents.Add({Base.GetData(), static_cast<size_t>(Base.Num())});
		for (const TArray<uint8>& File : Added)
		{
			Contents.Add({File.GetData(), static_cast<size_t>(File.Num())});
		}
		return FLipzDialogue::Open(Contents, Error);
	}
}

ULipzBank* ULipzBank::LoadBankFile(const FString& Path, FString& Error)
{
	TArray<uint8> Contents;
	if (!FFileHelper::LoadFileToArray(Contents, *Path))
	{
		Error = TEXT("the file cannot be read");
		return nullptr;
	}
	ULipzBank* Bank = NewObject<ULipzBank>();
	return Bank->SetContents(Contents, Error) ? Bank : nullptr;
}

bool ULipzBank::SetContents(const TArray<uint8>& Contents, FString& Error)
{
	TArray<uint8> Base = Contents;
	const TSharedPtr<FLipzDialogue> Opened = OpenFiles(Base, {}, Error);
	if (!Opened.IsValid())
	{
		return false;
	}
	Bytes = MoveTemp(Base);
	Added.Empty();
	Dialogue = Opened;
	bWasOpened = true;
	return true;
}

bool ULipzBank::AddFile(const TArray<uint8>& Contents, FString& Error)
{
	Added.Add(Contents);
	const TSharedPtr<FLipzDialogue> Opened = OpenFiles(Bytes, Added, Error);
	if (!Opened.IsValid())
	{
		Added.Pop();
		return false;
	}
	Dialogue = Opened;
	bWasOpened = true;
	return true;
}

TSharedPtr<FLipzDialogue> ULipzBank::GetDialogue() const
{
	if (!bWasOpened)
	{
		bWasOpened = true;
		FString Error;
		Dialogue = OpenFiles(Bytes, Added, Error);
		if (!Dialogue.IsValid())
		{
			UE_LOG(LogLipz, Error, TEXT("%s: %s. Import the bank again."), *GetPathName(), *Error);
		}
	}
	return Dialogue;
}

TArray<FString> ULipzBank::GetClipKeys(const FString& Prefix) const
{
	TArray<FString> Keys;
	if (const TSharedPtr<FLipzDialogue> Opened = GetDialogue())
	{
		const FTCHARToUTF8 Utf8(*Prefix);
		uint64_t Position = 0;
		lipz_clip Clip;
		lipz_string Key;
		while (lipz_dialogue_next_clip(Opened->Get(), Utf8.Get(), static_cast<size_t>(Utf8.Length()), &Position, &Clip) == LIPZ_OK)
		{
			lipz_clip_key(Opened->Get(), &Clip, &Key);
			Keys.Add(LipzStrings::ToFString(Key));
		}
	}
	return Keys;
}

bool ULipzBank::HasClip(const FString& Key) const
{
	const TSharedPtr<FLipzDialogue> Opened = GetDialogue();
	lipz_clip Clip;
	return Opened.IsValid() && Opened->FindClip(Key, Clip);
}

float ULipzBank::GetClipSeconds(const FString& Key) const
{
	const TSharedPtr<FLipzDialogue> Opened = GetDialogue();
	lipz_clip Clip;
	uint64_t Micros = 0;
	if (Opened.IsValid() && Opened->FindClip(Key, Clip))
	{
		lipz_clip_start_of_frame_us(Opened->Get(), &Clip, Clip.frame_count, &Micros);
	}
	return static_cast<float>(static_cast<double>(Micros) / 1e6);
}

TArray<FString> ULipzBank::GetLocales() const
{
	TArray<FString> Tags;
	if (const TSharedPtr<FLipzDialogue> Opened = GetDialogue())
	{
		lipz_locale Locale;
		for (uint32 Index = 0; lipz_dialogue_locale_by_index(Opened->Get(), Index, &Locale) == LIPZ_OK; Index++)
		{
			Tags.Add(LipzStrings::ToFString(Locale.tag));
		}
	}
	return Tags;
}

TArray<FString> ULipzBank::GetVoices() const
{
	TArray<FString> Tags;
	if (const TSharedPtr<FLipzDialogue> Opened = GetDialogue())
	{
		lipz_voice Voice;
		for (uint32 Index = 0; lipz_dialogue_voice_by_index(Opened->Get(), Index, &Voice) == LIPZ_OK; Index++)
		{
			Tags.Add(LipzStrings::ToFString(Voice.tag));
		}
	}
	return Tags;
}

FString ULipzBank::GetKeyInVoice(const FString& Key, const FString& Voice) const
{
	const TSharedPtr<FLipzDialogue> Opened = GetDialogue();
	const FString Wanted = Voice.ToLower();
	const FTCHARToUTF8 Utf8(*Wanted);
	lipz_clip Clip;
	lipz_voice Found;
	lipz_voiced_clip Voiced;
	lipz_string Spelled;
	if (Opened.IsValid() && Opened->FindClip(Key, Clip) &&
		lipz_dialogue_voice(Opened->Get(), Utf8.Get(), static_cast<size_t>(Utf8.Length()), &Found) == LIPZ_OK &&
		lipz_clip_in_voice(Opened->Get(), &Clip, &Found, &Voiced) == LIPZ_OK &&
		lipz_clip_key(Opened->Get(), &Voiced.clip, &Spelled) == LIPZ_OK)
	{
		return LipzStrings::ToFString(Spelled);
	}
	return Key;
}

FText ULipzBank::GetText(const FString& Key, int32 Segment, const FString& Locale) const
{
	const TSharedPtr<FLipzDialogue> Opened = GetDialogue();
	const FString Language = Locale.IsEmpty() ? FInternationalization::Get().GetCurrentLanguage()->GetName() : Locale;
	lipz_clip Clip;
	lipz_locale Found;
	lipz_segment Part;
	lipz_text Text;
	if (Opened.IsValid() && Segment >= 0 && Opened->FindClip(Key, Clip) && Opened->FindLocale(Language, Found) &&
		lipz_clip_segment(Opened->Get(), &Clip, static_cast<uint32>(Segment), &Part) == LIPZ_OK &&
		lipz_segment_text(Opened->Get(), &Part, &Found, &Text) == LIPZ_OK)
	{
		return FText::FromString(LipzStrings::ToFString({Text.data, Text.length_bytes}));
	}
	return FText();
}

FString ULipzBank::GetVisemeAt(const FString& Key, float Seconds) const
{
	const TSharedPtr<FLipzDialogue> Opened = GetDialogue();
	lipz_clip Clip;
	lipz_viseme Viseme = '-';
	if (Opened.IsValid() && Opened->FindClip(Key, Clip))
	{
		lipz_clip_viseme_at(Opened->Get(), &Clip, lipz_time_seconds_f32(Seconds), &Viseme);
	}
	const char Code = static_cast<char>(Viseme);
	return LipzStrings::ToFString({&Code, 1});
}

float ULipzBank::GetCurveAt(const FString& Key, const FString& Curve, float Seconds) const
{
	const TSharedPtr<FLipzDialogue> Opened = GetDialogue();
	const FTCHARToUTF8 Utf8(*Curve);
	lipz_clip Clip;
	lipz_curve Found;
	int32_t Thousandths = 0;
	if (Opened.IsValid() && Opened->FindClip(Key, Clip) &&
		lipz_clip_curve(Opened->Get(), &Clip, Utf8.Get(), static_cast<size_t>(Utf8.Length()), &Found) == LIPZ_OK)
	{
		lipz_curve_value_at(Opened->Get(), &Found, lipz_time_seconds_f32(Seconds), nullptr, &Thousandths);
	}
	return static_cast<float>(Thousandths) / 1000.0f;
}
