#pragma once

#include "CoreMinimal.h"
#include "UObject/Object.h"

#include "LipzBank.generated.h"

class FLipzDialogue;

/** A dialogue bank. The editor makes it from a .lipzbank file. */
UCLASS(BlueprintType)
class LIPZ_API ULipzBank : public UObject
{
	GENERATED_BODY()

public:
	/** Makes a bank from a file outside the project, such as a download. Returns null if the file is damaged. */
	UFUNCTION(BlueprintCallable, Category = "Lipz")
	static ULipzBank* LoadBankFile(const FString& Path, FString& Error);

	/** Replaces the bank. If the contents are damaged, returns false, describes the problem, and changes nothing. */
	UFUNCTION(BlueprintCallable, Category = "Lipz")
	bool SetContents(const TArray<uint8>& Contents, FString& Error);

	/**
	 * Adds the contents of a text bank (.lipztexts), of a patch or of the bank of a voice, until the game ends. If they
	 * do not fit this bank, returns false, describes the problem, and changes nothing.
	 */
	UFUNCTION(BlueprintCallable, Category = "Lipz")
	bool AddFile(const TArray<uint8>& Contents, FString& Error);

	/** The keys of the clips that start with Prefix. */
	UFUNCTION(BlueprintCallable, Category = "Lipz")
	TArray<FString> GetClipKeys(const FString& Prefix) const;

	UFUNCTION(BlueprintPure, Category = "Lipz")
	bool HasClip(const FString& Key) const;

	/** The length of a clip in seconds; 0 if it is missing or has no frame rate. */
	UFUNCTION(BlueprintPure, Category = "Lipz")
	float GetClipSeconds(const FString& Key) const;

	/** The locales of the texts, such as `de-de`. */
	UFUNCTION(BlueprintCallable, Category = "Lipz")
	TArray<FString> GetLocales() const;

	/** The locales of the recordings; empty without dubs. */
	UFUNCTION(BlueprintCallable, Category = "Lipz")
	TArray<FString> GetVoices() const;

	/** The key of the clip for the recording in a voice: of a dub, or of the line itself if it is not dubbed. */
	UFUNCTION(BlueprintPure, Category = "Lipz")
	FString GetKeyInVoice(const FString& Key, const FString& Voice) const;

	/** The text of a segment, from 0, in a locale or its fallback. An empty locale is the language of the game. */
	UFUNCTION(BlueprintPure, Category = "Lipz")
	FText GetText(const FString& Key, int32 Segment, const FString& Locale) const;

	/** The viseme at a time, a single letter or digit; "-" at rest. */
	UFUNCTION(BlueprintPure, Category = "Lipz")
	FString GetVisemeAt(const FString& Key, float Seconds) const;

	/** The value of a curve of a clip at a time; 0 if the clip has no such curve. */
	UFUNCTION(BlueprintPure, Category = "Lipz")
	float GetCurveAt(const FString& Key, const FString& Curve, float Seconds) const;

	/** The open bank, for code that calls lipz.h; null if the asset is empty or damaged. Ask again in each frame. */
	TSharedPtr<FLipzDialogue> GetDialogue() const;

#if WITH_EDITORONLY_DATA
	/** The file that the bank was imported from. */
	UPROPERTY(VisibleAnywhere, Instanced, Category = "Import")
	TObjectPtr<class UAssetImportData> AssetImportData;
#endif

private:
	UPROPERTY()
	TArray<uint8> Bytes;

	/** Files that were added. They stay at their addresses, because the bytes of moved arrays do. */
	TArray<TArray<uint8>> Added;

	mutable TSharedPtr<FLipzDialogue> Dialogue;

	/** Whether opening the bytes of the asset was tried. */
	mutable bool bWasOpened = false;
};
