#include "LipzDialogue.h"

#include "LipzStrings.h"

TSharedPtr<FLipzDialogue> FLipzDialogue::Open(const TArray<lipz_bytes>& Contents, FString& OutError)
{
	TSharedPtr<FLipzDialogue> Opened = MakeShareable(new FLipzDialogue());
	Opened->Files.SetNumZeroed(Contents.Num());
	lipz_problem Problem = {};
	const lipz_status Status = lipz_dialogue_open(&Opened->Dialogue, Opened->Files.GetData(), Contents.GetData(),
		static_cast<size_t>(Contents.Num()), 0, &Problem);
	if (Status == LIPZ_OK)
	{
		OutError.Reset();
		return Opened;
	}
	OutError = FString::Printf(TEXT("%s (file %u, byte %u)"), *LipzStrings::Message(Status), Problem.file, Problem.offset_bytes);
	return nullptr;
}

bool FLipzDialogue::FindClip(const FString& Key, lipz_clip& OutClip) const
{
	const FTCHARToUTF8 Utf8(*Key);
	return lipz_dialogue_clip_by_key(Get(), Utf8.Get(), static_cast<size_t>(Utf8.Length()), &OutClip) == LIPZ_OK;
}

bool FLipzDialogue::FindRig(const FString& Name, lipz_rig& OutRig) const
{
	const FTCHARToUTF8 Utf8(*Name);
	return lipz_dialogue_rig(Get(), Utf8.Get(), static_cast<size_t>(Utf8.Length()), &OutRig) == LIPZ_OK;
}

bool FLipzDialogue::FindLocale(const FString& Language, lipz_locale& OutLocale) const
{
	const FString Wanted = Language.ToLower().Replace(TEXT("_"), TEXT("-"));
	if (!Wanted.IsEmpty())
	{
		const FTCHARToUTF8 Utf8(*Wanted);
		if (lipz_dialogue_locale(Get(), Utf8.Get(), static_cast<size_t>(Utf8.Length()), &OutLocale) == LIPZ_OK)
		{
			return true;
		}
		int32 Hyphen = 0;
		const FString Prefix = (Wanted.FindChar(TEXT('-'), Hyphen) ? Wanted.Left(Hyphen) : Wanted) + TEXT("-");
		for (uint32 Index = 0; lipz_dialogue_locale_by_index(Get(), Index, &OutLocale) == LIPZ_OK; Index++)
		{
			const FString Tag = LipzStrings::ToFString(OutLocale.tag);
			if (Tag.StartsWith(Prefix) && !Tag.Contains(TEXT("-x-")))
			{
				return true;
			}
		}
	}
	return lipz_dialogue_locale(Get(), nullptr, 0, &OutLocale) == LIPZ_OK;
}
