using System;
using System.Collections.Generic;
using UnityEngine;

namespace Lipz
{
    /// <summary>A dialogue bank as an asset. The importer makes it from a <c>.lipzbank</c> file.</summary>
    public sealed class LipzBank : ScriptableObject
    {
        [SerializeField, HideInInspector]
        private byte[] bytes;

        [NonSerialized]
        private byte[] openedBytes;

        [NonSerialized]
        private Bank opened;

        [NonSerialized]
        private readonly List<LipzTexts> added = new List<LipzTexts>();

        /// <summary>Makes an asset from the bytes of a bank, for example of a download.</summary>
        /// <exception cref="BankException">The bytes are not a bank, or they are damaged.</exception>
        public static LipzBank From(byte[] bytes)
        {
            Bank bank = Bank.Open(bytes);
            bank.VerifyChecksum();
            var asset = CreateInstance<LipzBank>();
            asset.bytes = asset.openedBytes = bytes;
            asset.opened = bank;
            return asset;
        }

        /// <summary>The bank, which is opened once.</summary>
        public Bank Bank
        {
            get
            {
                // A new import replaces the bytes.
                if (opened != null && openedBytes == bytes) return opened;
                opened = Bank.Open(bytes);
                openedBytes = bytes;
                added.Clear();
                return opened;
            }
        }

        /// <summary>Adds the locales of a text bank (<c>split-locales</c>), once.</summary>
        /// <exception cref="BankException">The texts belong to a different bank.</exception>
        public void Add(LipzTexts texts)
        {
            Bank bank = Bank;
            if (added.Contains(texts)) return;
            bank.OpenTexts(texts.Bytes);
            added.Add(texts);
        }
    }
}
