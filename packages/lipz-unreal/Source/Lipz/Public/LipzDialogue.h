#pragma once

#include "CoreMinimal.h"

THIRD_PARTY_INCLUDES_START
#include "lipz.h"
THIRD_PARTY_INCLUDES_END

/** Open files of the C library, for code that calls lipz.h. Blueprints use ULipzBank. */
class LIPZ_API FLipzDialogue
{
public:
	/**
	 * Opens and verifies files: a bank, then patches and text banks. The contents must outlive the dialogue. Returns
	 * null, and describes the problem, if a file is damaged or does not fit the others.
	 */
	static TSharedPtr<FLipzDialogue> Open(const TArray<lipz_bytes>& Contents, FString& OutError);

	/** The pointer for functions of lipz.h. */
	const lipz_dialogue* Get() const { return &Dialogue; }

	bool FindClip(const FString& Key, lipz_clip& OutClip) const;

	/** Finds the rig, whose name is in [rig] of lipz.toml. */
	bool FindRig(const FString& Name, lipz_rig& OutRig) const;

	/**
	 * Finds the locale for a language of Unreal, such as `de-DE` or `de`: the locale itself, or else one of the same
	 * language. Otherwise, or if Language is empty, finds the default locale. Returns false without any locale.
	 */
	bool FindLocale(const FString& Language, lipz_locale& OutLocale) const;

	FLipzDialogue(const FLipzDialogue&) = delete;
	FLipzDialogue& operator=(const FLipzDialogue&) = delete;

private:
	FLipzDialogue() = default;

	TArray<lipz_file> Files;
	lipz_dialogue Dialogue = {};
};
